// Compares the upper bound on the probability of a wrong place on known sheets with the sum over
// all places, computed in double precision.
#include "device/sheet_odds.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/integrity/confidence.hpp"
#include "device/sheet_search.hpp"
#include "drawn_grid.hpp"

namespace dotpose::core_test::sheet_odds_test {
namespace {

using core::Axis;

constexpr std::uint64_t kSeed = 4219;
/// A sheet with more than 63 columns and rows. It therefore contains places that are 63 cells apart
/// along one axis. Such places have equal bits on the other axis.
constexpr KnownRegion kSheet{CodeVariant::anoto, {3, 5}, {1000, 2000}, 140, 130};

const core::KnownSheets kOnly{{&kSheet, 1}, OtherSheets::impossible};

int wrong_bits(const core::HardBlock& block, int quarters, const Place& corner) {
    const core::HardLines columns = block.lines(Axis::x, quarters);
    const core::HardLines rows = block.lines(Axis::y, quarters);
    int wrong = 0;
    for (int i = 0; i < columns.count; ++i) {
        for (int j = 0; j < rows.count; ++j) {
            if ((columns[i].seen >> j & 1) == 0) continue;
            const Place at = moved(kSheet.code, corner, i, j);
            const Symbol symbol = symbol_at(kSheet.code, at.cell, at.section);
            wrong += static_cast<int>(columns[i].bits >> j & 1) != x_bit(symbol);
            wrong += static_cast<int>(rows[j].bits >> i & 1) != y_bit(symbol);
        }
    }
    return wrong;
}

/// Returns the total odds of all places except the upright place at `corner`, relative to the odds
/// of that place.
double odds_of_others(const core::HardBlock& block, const Place& corner) {
    const int wrong = wrong_bits(block, 0, corner);
    const double per_bit =
        core::odds_per_bit_q8(core::Confidence::of_hard_bits(2 * block.dots(), wrong)) / 256.0;
    double sum = 0;
    for (int quarters = 0; quarters < 4; ++quarters) {
        for (std::uint32_t x = kSheet.first.x - 5; x < kSheet.first.x + kSheet.columns; ++x) {
            for (std::uint32_t y = kSheet.first.y - 5; y < kSheet.first.y + kSheet.rows; ++y) {
                const Place place{{x, y}, kSheet.section};
                if (quarters == 0 && place == corner) continue;
                sum += std::exp2(-per_bit * (wrong_bits(block, quarters, place) - wrong));
            }
        }
    }
    return sum;
}

bool is_certain(const core::HardBlock& block, const Place& corner, const core::KnownSheets& sheets,
                Fix& fix, const IntegrityOptions& options = {}) {
    return core::is_certain_place(sheets, kSheet.code, block.lines(Axis::x, 0),
                                  block.lines(Axis::y, 0), corner, options, fix);
}

TEST(SheetOdds, BoundIsAboveTheSumOverAllPlaces) {
    Rng rng(kSeed);
    for (int trial = 0; trial < 12; ++trial) {
        const Place corner{{1000 + rng.below(130), 2000 + rng.below(120)}, kSheet.section};
        const Drawing drawing{.wrong = trial % 3 * 0.02, .missing = trial % 4 * 0.08};
        const DrawnGrid drawn(kSheet, corner.cell, drawing, rng);
        const core::HardBlock block(drawn.grid(), drawn.region());
        Fix fix;
        is_certain(block, corner, kOnly, fix);
        const double sum_log2 = std::log2(odds_of_others(block, corner));
        EXPECT_GE(fix.p_wrong_log2, sum_log2) << trial;
        // `chance` is the probability that random bits have at most `fix.bit_errors` errors at one
        // given place. The corner of the block has 145 * 135 possible places, each in 4
        // orientations.
        double chance = 0;
        double term = std::exp2(-2 * block.dots());
        for (int k = 0; k <= fix.bit_errors; ++k) {
            chance += term;
            term *= (2.0 * block.dots() - k) / (k + 1);
        }
        const double expected_log2 = std::log2(std::exp2(sum_log2) + 4 * 145 * 135 * chance);
        // In log2, rounding up adds at most 1, and the Chernoff bound exceeds the binomial sum by
        // at most 3.
        EXPECT_LE(fix.p_wrong_log2, expected_log2 + 4) << trial;
    }
}

TEST(SheetOdds, MoreDotsAreNeededIfOtherSheetsArePossible) {
    Rng rng(kSeed, 1);
    const Place corner{{1050, 2060}, kSheet.section};
    const DrawnGrid drawn(kSheet, corner.cell, {.columns = 6, .rows = 6}, rng);
    const core::HardBlock block(drawn.grid(), drawn.region());
    Fix fix;
    EXPECT_TRUE(is_certain(block, corner, kOnly, fix));
    EXPECT_EQ(fix.prior, Prior::only_sheets);
    const int only_log2 = fix.p_wrong_log2;
    const core::KnownSheets possible{{&kSheet, 1}, OtherSheets::possible};
    is_certain(block, corner, possible, fix);
    // An unknown sheet may have the same columns as the known sheet. The rows that were read can
    // then match by chance at 3 positions on the unknown sheet, with a probability of 2^-36 at
    // each.
    EXPECT_GE(fix.p_wrong_log2, -36);
    EXPECT_GT(fix.p_wrong_log2, only_log2);
}

TEST(SheetOdds, PlacesBesideTheSheetsAreNotCertain) {
    Rng rng(kSeed, 2);
    const Place corner{{1200, 2060}, kSheet.section};
    const DrawnGrid drawn(kSheet, corner.cell, {.columns = 8, .rows = 8}, rng);
    const core::HardBlock block(drawn.grid(), drawn.region());
    Fix fix;
    EXPECT_FALSE(is_certain(block, corner, kOnly, fix));
}

TEST(SheetOdds, TooManyWrongBitsAreRefused) {
    Rng rng(kSeed, 3);
    const Place corner{{1050, 2060}, kSheet.section};
    const DrawnGrid drawn(kSheet, corner.cell, {.columns = 10, .rows = 10, .wrong = 0.1}, rng);
    const core::HardBlock block(drawn.grid(), drawn.region());
    Fix fix;
    EXPECT_TRUE(is_certain(block, corner, kOnly, fix));
    EXPECT_FALSE(is_certain(block, corner, kOnly, fix, {.max_bit_error_q8 = 5}));
}

TEST(SheetOdds, MaximumOfWrongBitsFollowsFromChance) {
    // 4 * 145 * 135 places are 2^16.3 hypotheses. If 48 bits agree without an error, the
    // probability of a match by chance is 2^-31.7. If one of the 48 bits is wrong, the probability
    // is 2^-26.
    EXPECT_EQ(core::max_wrong_bits(kOnly, kSheet.code, 24, 6, {}), 0);
    EXPECT_EQ(core::max_wrong_bits(kOnly, kSheet.code, 22, 6, {}), -1);
    EXPECT_EQ(core::max_wrong_bits(kOnly, kSheet.code, 200, 16, {}), 400);
}

}  // namespace
}  // namespace dotpose::core_test::sheet_odds_test
