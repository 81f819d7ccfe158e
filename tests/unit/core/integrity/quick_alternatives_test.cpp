// Tests the quick estimate of the odds of alternatives against double-precision sums.
#include "core/integrity/quick_alternatives.hpp"

#include <gtest/gtest.h>

#include "ratios_case.hpp"

namespace dotpose::core_test::quick_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 51;

/// Returns lines with missing, weak and wrong bits, and random odds per bit.
RatiosCase random_case(Rng& rng) {
    RatiosCase c =
        at_random_place(rng, 6 + static_cast<int>(rng.below(rng.below(2) == 0 ? 12 : 59)));
    const int bits = 6 + static_cast<int>(rng.below(rng.below(2) == 0 ? 12 : 59));
    const double wrong = rng.uniform(0, 0.1);
    for (const int own : c.rolls) {
        const int seen = static_cast<int>(rng.uniform(0.6, 1) * bits);
        c.storage.push_back(
            scored_line(own, seen, wrong, 60 + static_cast<int>(rng.below(68)), rng));
    }
    c.odds_q8 = static_cast<int>(256 * rng.uniform(2, 8));
    return c;
}

/// Returns log2 of the quick estimate, and expects the estimate to be at least the sum of the odds
/// of the single alternatives.
double checked(const RatiosCase& c) {
    const double quick = quick_alternatives_log2_q8(c.ratios()) / 256.0;
    EXPECT_LE(quick, 0);
    if (quick < 0) {
        EXPECT_GE(quick, std::log2(sum_of_singles(c)));
    }
    return quick;
}

TEST(QuickAlternatives, CountAllThatDifferInOneSequence) {
    Rng rng(kSeed);
    int far_below_doubt = 0;
    for (int i = 0; i < 400; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
        far_below_doubt += checked(random_case(rng)) < -30;
    }
    EXPECT_GE(far_below_doubt, 80) << "seed " << kSeed;
}

TEST(QuickAlternatives, CountWhatSharesTheOnlyLinesThatSayMuch) {
    // An alternative may share five consecutive lines with the reading, or seven lines in
    // `libdots`. Here, only four to nine consecutive lines have clear bits. An alternative that
    // shares nearly all of these lines loses little, and must be counted.
    Rng rng(kSeed);
    int told = 0;
    for (int i = 0; i < 400; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
        RatiosCase c = at_random_place(rng, 6 + static_cast<int>(rng.below(30)));
        const auto clear = rng.below(static_cast<std::uint32_t>(c.rolls.size()));
        const std::uint32_t clear_lines = 4 + rng.below(6);
        for (std::uint32_t line = 0; line < c.rolls.size(); ++line) {
            const bool is_clear = line >= clear && line < clear + clear_lines;
            c.storage.push_back(is_clear ? scored_line(c.rolls[line], 64, 0, 127, rng)
                                         : scored_line(c.rolls[line], 10, 0.05, 20, rng));
        }
        c.odds_q8 = static_cast<int>(256 * rng.uniform(0.5, 8));
        told += checked(c) < 0;
    }
    EXPECT_GE(told, 40) << "seed " << kSeed;
}

TEST(QuickAlternatives, CountOthersThatLinesFitBetter) {
    // Some lines have the bits of a random roll. In these lines, an alternative with this roll
    // scores higher than the reading.
    Rng rng(kSeed);
    int told = 0;
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
        RatiosCase c = at_random_place(rng, 15 + static_cast<int>(rng.below(30)));
        for (const int own : c.rolls) {
            const int shown = rng.below(15) == 0 ? static_cast<int>(rng.below(63)) : own;
            c.storage.push_back(scored_line(shown, 40, 0.05, 127, rng));
        }
        c.odds_q8 = static_cast<int>(256 * rng.uniform(1, 4));
        told += checked(c) < 0;
    }
    EXPECT_GE(told, 40) << "seed " << kSeed;
}

TEST(QuickAlternatives, FewLinesOrWeakOddsDoNotTell) {
    Rng rng(kSeed);
    for (int lines = 1; lines <= 5; ++lines) {
        RatiosCase c = at_random_place(rng, lines);
        for (const int own : c.rolls)
            c.storage.push_back(scored_line(own, 20, 0, 127, rng));
        c.odds_q8 = 8 * 256;
        EXPECT_EQ(quick_alternatives_log2_q8(c.ratios()), 0) << lines;
    }
    RatiosCase c = at_random_place(rng, 17);
    for (const int own : c.rolls)
        c.storage.push_back(scored_line(own, 12, 0, 127, rng));
    c.odds_q8 = 8;
    EXPECT_EQ(quick_alternatives_log2_q8(c.ratios()), 0);
    c.odds_q8 = 8 * 256;
    EXPECT_LT(quick_alternatives_log2_q8(c.ratios()), -30 * 256);
}

}  // namespace
}  // namespace dotpose::core_test::quick_alternatives_test
