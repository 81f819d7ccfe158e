// Tests sum_of_planned_alternatives with lines that agree with the reading and, almost as well,
// with one alternative. Also tests the result and the work limit of wrong_in_small_view.
#include "core/integrity/planned_alternatives.hpp"

#include <array>
#include <bit>
#include <optional>
#include <span>

#include <gtest/gtest.h>

#include "core/integrity/alternatives.hpp"
#include "core/integrity/small_views.hpp"
#include "core/kernels/select.hpp"
#include "similar_case.hpp"

namespace dotpose::core_test::planned_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 71;
constexpr float kMaxRest = 0x1p-31F;  // maximum contribution of expected odds to the sum
constexpr std::size_t kPlenty = 10'000'000;

std::optional<float> planned(const RatiosCase& c, float max_odds, std::size_t max_work) {
    const LikelihoodRatios ratios = c.ratios();
    WorkLimit work(max_work);
    const RankedLines lines(ratios);
    return sum_of_planned_alternatives(lines, SetPlan(lines), 1, max_odds, work);
}

TEST(PlannedAlternatives, AreFoundIfTheyDifferInTwoOrMoreSequences) {
    Rng rng(kSeed);
    int searched = 0;
    for (int i = 0; i < 10; ++i) {
        for (unsigned different = 0; different < 16; ++different) {
            if (std::popcount(different) < 2) continue;
            const SimilarCase c(rng, different);
            const double exact = odds_of_rolls(c.lines, c.rolls);
            const std::optional<float> sum = planned(c.lines, 1, kPlenty);
            if (!sum) continue;
            ++searched;
            EXPECT_GE(static_cast<double>(*sum), 0.96 * exact) << i << ", " << different;
            EXPECT_LE(static_cast<double>(*sum), 1.04 * exact + static_cast<double>(kMaxRest))
                << i << ", " << different;
        }
    }
    EXPECT_GE(searched, 80) << "of 110, seed " << kSeed;
}

TEST(PlannedAlternatives, DoNotIncludeSingleAlternatives) {
    Rng rng(kSeed);
    for (const unsigned different : {1U, 2U, 4U, 8U}) {
        std::optional<float> sum;
        while (!sum) {
            const SimilarCase c(rng, different);
            ASSERT_GT(odds_of_rolls(c.lines, c.rolls), 0x1p-12);
            sum = planned(c.lines, 1, kPlenty);
        }
        EXPECT_LT(*sum, 0x1p-13F) << different;
    }
}

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
    return wrong_in_small_view(kernels, std::span(both).first(axes.size()), 1, max_wrong, work);
}

TEST(SmallViews, EndAtTheWorkLimit) {
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

TEST(SmallViews, UseOneLimitForBothAxes) {
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

TEST(SmallViews, AreAtLeastAsWrongAsTheirMostSimilarAlternative) {
    Rng rng(kSeed);
    int found = 0;
    for (int i = 0; i < 20; ++i) {
        for (unsigned different = 1; different < 16; ++different) {
            const SimilarCase c(rng, different);
            const double exact = odds_of_rolls(c.lines, c.rolls);
            const float wrong = wrong_in(kernels(), std::span(&c.lines, 1), 1, kPlenty);
            EXPECT_GE(static_cast<double>(wrong), 0.96 * exact) << i << ", " << different;
            found += wrong < 1 ? 1 : 0;
        }
    }
    EXPECT_GE(found, 100) << "of 300, seed " << kSeed;
}

}  // namespace
}  // namespace dotpose::core_test::planned_alternatives_test
