// Tests sum_of_planned_alternatives with lines that agree with the reading and, almost as well,
// with one alternative.
#include "core/integrity/planned_alternatives.hpp"

#include <bit>
#include <optional>

#include <gtest/gtest.h>

#include "similar_case.hpp"

namespace dotpose::core_test::planned_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 71;
constexpr float kMaxRest = 0x1p-31F;  // maximum contribution of expected odds to the sum
constexpr std::size_t kPlenty = 10'000'000;

std::optional<float> planned(const RatiosCase& c, float max_odds, std::size_t max_work) {
    const LikelihoodRatios ratios = c.ratios();
    WorkLimit work(max_work);
    const LossTables lines(ratios);
    const SetPlan plan(lines, 0, work);
    if (!plan.is_complete()) return {};
    return sum_of_planned_alternatives(lines, plan, 0, 1, max_odds, work);
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

}  // namespace
}  // namespace dotpose::core_test::planned_alternatives_test
