// Tests the list of sets whose far alternatives are searched.
#include "core/integrity/set_plan.hpp"

#include <gtest/gtest.h>

#include "ratios_case.hpp"

namespace dotpose::core_test::set_plan_test {
namespace {

constexpr std::uint64_t kSeed = 81;
constexpr std::size_t kPlenty = 10'000'000;

/// Returns a view of 8 to 23 lines, in which some bits are wrong.
RatiosCase random_view(Rng& rng) {
    RatiosCase c = at_random_place(rng, 8 + static_cast<int>(rng.below(16)));
    c.odds_q8 = 3 * 256;
    for (const int roll : c.rolls)
        c.storage.push_back(scored_line(roll, 8 + static_cast<int>(rng.below(8)), 0.05, 127, rng));
    return c;
}

/// Calls `use(plan, ratios)` for the complete plans of random views.
void for_each_plan(const auto& use) {
    Rng rng(kSeed);
    int complete = 0;
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        const RatiosCase c = random_view(rng);
        const LikelihoodRatios ratios = c.ratios();
        const LossTables lines(ratios);
        WorkLimit work(kPlenty);
        const SetPlan plan(lines, 0, work);
        if (!plan.is_complete()) continue;
        ++complete;
        use(plan, ratios);
    }
    EXPECT_GE(complete, 20) << "seed " << kSeed;
}

int min_loss_outside(LineSet shared, const LikelihoodRatios& ratios) {
    int lost = 0;
    for (int line = 0; line < ratios.count(); ++line) {
        if ((shared >> line & 1) == 0) lost += std::max(ratios.min_loss(line), 0);
    }
    return lost;
}

TEST(SetPlan, RequiresShortSearchesIfAlternativesMayLoseLessThan24Bits) {
    int required = 0;
    for_each_plan([&](const SetPlan& plan, const LikelihoodRatios& ratios) {
        bool are_required = true;
        for (const PlannedSet& set : plan.sets()) {
            const bool loses_little =
                min_loss_outside(set.shared, ratios) < ratios.loss_for(-24 * 256);
            EXPECT_EQ(set.is_required, loses_little && set.work < 1e6F);
            EXPECT_TRUE(are_required || !set.is_required) << "the required sets come first";
            are_required = set.is_required;
            required += set.is_required ? 1 : 0;
        }
    });
    EXPECT_GE(required, 100) << "seed " << kSeed;
}

TEST(SetPlan, ListsNoSetThatARequiredSetCovers) {
    for_each_plan([](const SetPlan& plan, const LikelihoodRatios&) {
        for (const PlannedSet& set : plan.sets()) {
            for (const PlannedSet& other : plan.sets()) {
                if (!other.is_required || &other == &set) continue;
                EXPECT_NE(set.shared & other.shared, other.shared);
            }
        }
    });
}

TEST(SetPlan, LeavesARestThatDecreasesWithEachSet) {
    for_each_plan([](const SetPlan& plan, const LikelihoodRatios&) {
        for (std::size_t n = 0; n < plan.sets().size(); ++n) {
            EXPECT_NEAR(plan.rest(n) - plan.rest(n + 1), plan.sets()[n].expected,
                        1e-5F * plan.rest(n));
        }
        EXPECT_LE(plan.count_for(plan.rest(0) / 2), plan.sets().size());
        EXPECT_LE(plan.work_of(0), plan.work_of(plan.sets().size()));
    });
}

TEST(SetPlan, IsIncompleteIfListingTheSetsExceedsTheWorkLimit) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        const RatiosCase c = random_view(rng);
        const LikelihoodRatios ratios = c.ratios();
        const LossTables lines(ratios);
        WorkLimit little(300);
        EXPECT_FALSE(SetPlan(lines, 0, little).is_complete()) << i << ", seed " << kSeed;
        EXPECT_EQ(little.left(), 0U) << i << ", seed " << kSeed;
    }
}

}  // namespace
}  // namespace dotpose::core_test::set_plan_test
