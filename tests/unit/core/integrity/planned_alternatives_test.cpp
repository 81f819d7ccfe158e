// Tests sum_of_planned_alternatives with lines that agree with the reading and, almost as well,
// with one alternative. Also tests that the work limit ends the search in views with few lines.
#include "core/integrity/planned_alternatives.hpp"

#include <bit>
#include <optional>

#include <gtest/gtest.h>

#include "core/integrity/alternatives.hpp"
#include "core/kernels/select.hpp"
#include "similar_case.hpp"

namespace dotpose::core_test::planned_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 71;
constexpr float kMaxRest = 0x1p-16F;
constexpr std::size_t kPlenty = 10'000'000;

std::optional<float> planned(const RatiosCase& c, float max_odds, std::size_t most_work) {
    const LikelihoodRatios ratios = c.ratios();
    WorkLimit work(most_work);
    return sum_of_planned_alternatives(RankedLines(ratios), kMaxRest, max_odds, work);
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

/// Returns a view of ten lines with nine correct bits each, as in a frame of 64 x 64 px.
RatiosCase small_view(Rng& rng) {
    RatiosCase c = at_random_place(rng, 10);
    c.odds_q8 = 1650;
    for (const int roll : c.rolls)
        c.storage.push_back(scored_line(roll, 9, 0, 127, rng));
    return c;
}

TEST(PlannedAlternatives, OfSmallViewsEndAtTheWorkLimit) {
    Rng rng(kSeed);
    int found = 0;
    for (int i = 0; i < 50; ++i) {
        const RatiosCase c = small_view(rng);
        const auto sum_with = [&](std::size_t most_work) {
            WorkLimit work(most_work);
            return sum_of_alternatives(kernels(), c.ratios(), -30, work);
        };
        // The limit leaves 5,000 instructions after the other sums, which take 90,000. One set of
        // lines takes more than 1,000.
        EXPECT_GE(sum_with(95'000), 1) << i;
        found += sum_with(kPlenty) < 0x1p-30F ? 1 : 0;
    }
    EXPECT_GE(found, 10) << "seed " << kSeed;
}

}  // namespace
}  // namespace dotpose::core_test::planned_alternatives_test
