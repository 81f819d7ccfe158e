// Tests the probability that an alternative is correct: that it is at least the odds of a similar
// alternative, and that its limits apply.
#include "core/integrity/alternatives.hpp"

#include <array>
#include <span>

#include <gtest/gtest.h>

#include "core/kernels/select.hpp"
#include "similar_case.hpp"

namespace dotpose::core_test::alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 71;
constexpr std::size_t kPlenty = 10'000'000;

/// Returns a view of ten lines, each with nine correct bits, as in a frame of 64 x 64 px.
RatiosCase small_view(Rng& rng) {
    RatiosCase c = at_random_place(rng, 10);
    c.odds_q8 = 1650;
    for (const int roll : c.rolls)
        c.storage.push_back(scored_line(roll, 9, 0, 127, rng));
    return c;
}

float wrong_in(const Kernels& kernels, std::span<const RatiosCase> axes, float max_wrong,
               std::size_t max_work) {
    const LikelihoodRatios x = axes.front().ratios();
    const LikelihoodRatios y = axes.back().ratios();
    const UnsharedLines x_unshared(kernels, x);
    const UnsharedLines y_unshared(kernels, y);
    const std::array both{&x_unshared, &y_unshared};
    WorkLimit work(max_work);
    return wrong_by_alternatives(kernels, std::span(both).first(axes.size()), 1, max_wrong, work);
}

TEST(Alternatives, EndAtTheWorkLimit) {
    Rng rng(kSeed);
    int found = 0;
    for (int i = 0; i < 50; ++i) {
        const std::array axis{small_view(rng)};
        // The preparation takes 80,000 instructions, which leaves 5,000 for the search. This is not
        // enough, because the search takes at least 1,500 instructions per set of lines.
        EXPECT_GE(wrong_in(kernels(), axis, 0x1p-30F, 85'000), 1) << i;
        found += wrong_in(kernels(), axis, 0x1p-30F, kPlenty) < 0x1p-30F ? 1 : 0;
    }
    EXPECT_GE(found, 10) << "seed " << kSeed;
}

TEST(Alternatives, UseOneLimitForBothAxes) {
    Rng rng(kSeed);
    int found = 0;
    for (int i = 0; i < 50; ++i) {
        const std::array axes{small_view(rng), small_view(rng)};
        const float both = wrong_in(kernels(), axes, 0x1p-30F, kPlenty);
        if (both >= 1) continue;
        ++found;
        EXPECT_LE(both, 0x1p-30F) << i;
        // The result for each axis alone must also be within the limit.
        for (const RatiosCase& axis : axes)
            EXPECT_LE(wrong_in(kernels(), std::span(&axis, 1), 0x1p-30F, kPlenty), 0x1p-30F) << i;
    }
    EXPECT_GE(found, 5) << "seed " << kSeed;
}

TEST(Alternatives, AreLessProbableWithMoreLines) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        RatiosCase c = at_random_place(rng, 24);
        c.odds_q8 = 5 * 256;
        for (const int roll : c.rolls)
            c.storage.push_back(scored_line(roll, 12, 0, 127, rng));
        float before = 1;
        for (const std::size_t lines : {8U, 10U, 16U, 24U}) {
            RatiosCase first = c;
            first.storage.resize(lines);
            first.rolls.resize(lines);
            const float wrong = wrong_in(kernels(), std::span(&first, 1), 0x1p-30F, kPlenty);
            // The sum contains at most 2^-31 of expected odds.
            ASSERT_LE(wrong, before + 0x1p-31F) << lines << " lines, " << i << ", seed " << kSeed;
            before = wrong;
        }
        EXPECT_LE(before, 0x1p-30F) << i << ", seed " << kSeed;
    }
}

TEST(Alternatives, AreTooProbableIfOneIsSimilar) {
    Rng rng(kSeed);
    int certain = 0;
    for (int i = 0; i < 20; ++i) {
        for (unsigned different = 1; different < 16; ++different) {
            SimilarCase c(rng, different);
            const auto wrong = [&] {
                return wrong_in(kernels(), std::span(&c.lines, 1), 0x1p-30F, kPlenty);
            };
            ASSERT_GT(odds_of_rolls(c.lines, c.rolls), 0x1p-24);
            EXPECT_EQ(wrong(), 1) << i << ", " << different << ", seed " << kSeed;
            // Without the similar alternative, the reading is certain.
            for (std::size_t line = 0; line < SimilarCase::kLines; ++line) {
                ScoredLine& scored = c.lines.storage[line];
                if (c.rolls[line] != c.lines.rolls[line])
                    scored.scores[static_cast<std::size_t>(c.rolls[line])] = -1800;
            }
            certain += wrong() < 1 ? 1 : 0;
        }
    }
    EXPECT_GE(certain, 200) << "of 300, seed " << kSeed;
}

}  // namespace
}  // namespace dotpose::core_test::alternatives_test
