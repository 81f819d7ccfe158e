// Tests minimum losses against an enumeration of all patterns of shared lines.
#include "core/integrity/min_losses.hpp"

#include <gtest/gtest.h>

#include "ratios_case.hpp"

namespace dotpose::core_test::min_losses_test {
namespace {

constexpr std::uint64_t kSeed = 77;

/// Returns `lines` lines of the code variant `code`. 8 % of their bits are wrong.
RatiosCase random_case(int lines, CodeVariant code, Rng& rng) {
    RatiosCase c = at_random_place(rng, lines);
    while (c.code != code)
        c = at_random_place(rng, lines);
    for (const int own : c.rolls)
        c.storage.push_back(scored_line(own, 6 + static_cast<int>(rng.below(14)), 0.08, 127, rng));
    c.odds_q8 = 4 * 256;
    return c;
}

/// Returns the minimum loss over all patterns with at most `max_shared` consecutive shared lines. A
/// pattern has one bit per line, which is set if the alternative shares the line with the reading.
int min_loss_of_patterns(const std::vector<int>& losses, int max_shared) {
    int least = INT32_MAX;
    for (std::uint32_t shared = 0; shared < 1U << losses.size(); ++shared) {
        int sum = 0;
        int run = 0;
        bool may_be = true;
        for (std::size_t line = 0; line < losses.size(); ++line) {
            const bool is_shared = (shared >> line & 1) != 0;
            run = is_shared ? run + 1 : 0;
            may_be = may_be && run <= max_shared;
            if (!is_shared) sum += losses[line];
        }
        if (may_be) least = std::min(least, sum);
    }
    return least;
}

/// Returns the loss of each line: the score at the roll of the reading minus the maximum score at
/// the other rolls, or 0 if this difference is negative.
std::vector<int> losses_of(const RatiosCase& c) {
    std::vector<int> losses;
    for (std::size_t line = 0; line < c.rolls.size(); ++line) {
        const LineScores& scores = c.storage[line].scores;
        const auto own = static_cast<std::size_t>(c.rolls[line]);
        int most = INT32_MIN;
        for (std::size_t roll = 0; roll < scores.size(); ++roll) {
            if (roll != own) most = std::max(most, int{scores[roll]});
        }
        losses.push_back(std::max(scores[own] - most, 0));
    }
    return losses;
}

TEST(MinLosses, AreTheMinimumOverAllPatternsOfSharedRuns) {
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
        const CodeVariant code = code_test::kCodeVariants[static_cast<std::size_t>(i % 3)];
        const int max_shared = code == CodeVariant::libdots ? 7 : 5;
        const RatiosCase c = random_case(1 + i % 12, code, rng);
        const std::vector<int> losses = losses_of(c);
        const std::vector<int> backwards(losses.rbegin(), losses.rend());
        const core::MinLosses from_first = core::min_losses(c.ratios(), false);
        const core::MinLosses from_last = core::min_losses(c.ratios(), true);
        for (std::size_t n = 0; n <= losses.size(); ++n) {
            const auto end = static_cast<std::ptrdiff_t>(n);
            EXPECT_EQ(from_first[n],
                      min_loss_of_patterns({losses.begin(), losses.begin() + end}, max_shared))
                << n;
            EXPECT_EQ(from_last[n], min_loss_of_patterns(
                                        {backwards.begin(), backwards.begin() + end}, max_shared))
                << n;
        }
    }
}

TEST(MinLosses, ABorderSeparatesTwoPatterns) {
    Rng rng(kSeed);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
        const CodeVariant code = code_test::kCodeVariants[static_cast<std::size_t>(i % 3)];
        const int max_shared = code == CodeVariant::libdots ? 7 : 5;
        const RatiosCase c = random_case(2 + i % 11, code, rng);
        const std::vector<int> losses = losses_of(c);
        int least = INT32_MAX;
        for (auto border = losses.begin(); border != losses.end(); ++border) {
            least = std::min(least, min_loss_of_patterns({losses.begin(), border}, max_shared) +
                                        min_loss_of_patterns({border, losses.end()}, max_shared));
        }
        EXPECT_EQ(core::min_loss_with_border(c.ratios()), least);
    }
}

}  // namespace
}  // namespace dotpose::core_test::min_losses_test
