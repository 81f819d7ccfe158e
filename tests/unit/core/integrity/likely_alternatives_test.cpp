// Tests sum_of_likely_alternatives with lines that agree with the reading and, almost as well, with
// one alternative. All other positions have much smaller odds.
#include "core/integrity/likely_alternatives.hpp"

#include <bit>
#include <optional>

#include <gtest/gtest.h>

#include "code/basis.hpp"
#include "core/kernels/select.hpp"
#include "similar_case.hpp"

namespace dotpose::core_test::likely_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 61;
constexpr float kMaxRest = 0x1p-16F;

std::optional<float> likely(const RatiosCase& c, float max_rest, float max_odds) {
    const LikelihoodRatios ratios = c.ratios();
    return sum_of_likely_alternatives(kernels(), RankedLines(ratios), max_rest, max_odds);
}

/// Returns a random case for which `sum_of_likely_alternatives` returns a sum. In other cases, the
/// search would take too long.
SimilarCase short_case(Rng& rng, unsigned different) {
    for (;;) {
        const SimilarCase c(rng, different);
        if (likely(c.lines, kMaxRest, 1)) return c;
    }
}

TEST(LikelyAlternatives, AreFoundIfTheyDifferInTwoOrMoreSequences) {
    Rng rng(kSeed);
    int searched = 0;
    for (int i = 0; i < 10; ++i) {
        for (unsigned different = 0; different < 16; ++different) {
            if (std::popcount(different) < 2) continue;
            const SimilarCase c(rng, different);
            const double exact = odds_of_rolls(c.lines, c.rolls);
            const std::optional<float> sum = likely(c.lines, kMaxRest, 1);
            if (!sum) continue;
            ++searched;
            EXPECT_GE(static_cast<double>(*sum), 0.96 * exact) << i << ", " << different;
            EXPECT_LE(static_cast<double>(*sum), 1.04 * exact + static_cast<double>(kMaxRest))
                << i << ", " << different;
        }
    }
    EXPECT_GE(searched, 80) << "of 110, seed " << kSeed;
}

TEST(LikelyAlternatives, DoNotIncludeSingleAlternatives) {
    Rng rng(kSeed);
    for (const unsigned different : {1U, 2U, 4U, 8U}) {
        const SimilarCase c = short_case(rng, different);
        ASSERT_GT(odds_of_rolls(c.lines, c.rolls), 0x1p-12);
        const std::optional<float> sum = likely(c.lines, kMaxRest, 1);
        ASSERT_TRUE(sum);
        EXPECT_LT(*sum, 0x1p-13F) << different;
    }
}

TEST(LikelyAlternatives, AreNotFurtherSummedAboveTheMaximum) {
    Rng rng(kSeed);
    const SimilarCase c = short_case(rng, 6);
    const std::optional<float> sum = likely(c.lines, kMaxRest, 0x1p-30F);
    ASSERT_TRUE(sum);
    EXPECT_GT(*sum, 0x1p-30F);
}

TEST(LikelyAlternatives, OfLinesWithoutInformationAreTooMany) {
    Rng rng(kSeed);
    SimilarCase c(rng, 6);
    for (std::size_t line = 4; line < SimilarCase::kLines; ++line)
        c.lines.storage[line] = {};
    const std::optional<float> sum = likely(c.lines, 0x1p-60F, 1);
    EXPECT_TRUE(!sum || *sum > 1);
}

}  // namespace
}  // namespace dotpose::core_test::likely_alternatives_test
