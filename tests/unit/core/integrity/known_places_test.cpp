// Tests the search for places on known sheets against an exhaustive search that computes in double
// precision.
#include "core/integrity/known_places.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/integrity/confidence.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::known_places_test {
namespace {

constexpr std::uint64_t kSeed = 4201;
constexpr int kMiddle = core::BitBlock::kMiddle;

/// A rectangle of cells, some of which were read.
struct Cells {
    int columns;
    int rows;
    std::vector<Symbol> symbols;
    std::vector<bool> is_read;
};

void set_bit(core::BitLines& lines, int line, int cell, int bit) {
    const auto i = static_cast<std::size_t>(line + kMiddle);
    lines.valid[i] |= std::uint64_t{1} << (cell + kMiddle);
    lines.bits[i] |= static_cast<std::uint64_t>(bit) << (cell + kMiddle);
}

/// Returns the bits of a rectangle of `sheet` with its upper left cell at `at`. Each bit is wrong
/// with probability `wrong`, and each cell is missing with probability `missing`.
Cells draw_cells(const KnownRegion& sheet, Cell at, int columns, int rows, double wrong,
                 double missing, Rng& rng) {
    Cells cells{columns, rows, {}, {}};
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const Place place = moved(sheet.code, {at, sheet.section}, i, j);
            const Symbol symbol = symbol_at(sheet.code, place.cell, place.section);
            const int x = x_bit(symbol) ^ static_cast<int>(rng.uniform() < wrong);
            const int y = y_bit(symbol) ^ static_cast<int>(rng.uniform() < wrong);
            cells.symbols.push_back(make_symbol(x, y));
            cells.is_read.push_back(rng.uniform() >= missing);
        }
    }
    return cells;
}

core::BitBlock block_of(const Cells& cells) {
    core::BitBlock block;
    for (int j = 0; j < cells.rows; ++j) {
        for (int i = 0; i < cells.columns; ++i) {
            const auto k = static_cast<std::size_t>(j * cells.columns + i);
            if (!cells.is_read[k]) continue;
            set_bit(block.columns, i, j, x_bit(cells.symbols[k]));
            set_bit(block.rows, j, i, y_bit(cells.symbols[k]));
        }
    }
    return block;
}

/// Returns, for each axis, the number of bits that disagree with the code if cell (0, 0) of the
/// block is at `place`.
std::array<int, 2> wrong_bits(const core::BitBlock& block, CodeVariant code, const Place& place) {
    std::array<int, 2> wrong{};
    for (int column = -kMiddle; column < kMiddle; ++column) {
        const auto i = static_cast<std::size_t>(column + kMiddle);
        for (int row = -kMiddle; row < kMiddle; ++row) {
            const auto j = static_cast<std::size_t>(row + kMiddle);
            if ((block.columns.valid[i] >> j & 1) == 0) continue;
            const Place at = moved(code, place, column, row);
            const Symbol symbol = symbol_at(code, at.cell, at.section);
            wrong[0] += x_bit(symbol) != static_cast<int>(block.columns.bits[i] >> j & 1);
            wrong[1] += y_bit(symbol) != static_cast<int>(block.rows.bits[j] >> i & 1);
        }
    }
    return wrong;
}

/// Returns the probability that at most `wrong` of `bits` random bits differ from a given bit
/// string.
double random_agreement(int bits, int wrong) {
    double term = std::exp2(-bits);
    double sum = 0;
    for (int k = 0; k <= wrong; ++k) {
        sum += term;
        term *= static_cast<double>(bits - k) / (k + 1);
    }
    return sum;
}

/// Returns the sum of the odds of all places on a sheet except `best`. The odds are relative to
/// those of `best`.
double other_odds(const core::BitBlock& block, const KnownRegion& sheet,
                  const core::KnownPlace& best) {
    core::Confidence confidence;
    const int wrong = best.wrong[0] + best.wrong[1];
    confidence.add(127, false, best.bits - wrong);
    confidence.add(127, true, wrong);
    const double log2_per_bit = core::odds_per_bit_q8(confidence) / 256.0;
    double sum = 0;
    for (int quarters = 0; quarters < 4; ++quarters) {
        const core::BitBlock upright = core::turned(quarters, block);
        const auto [columns, rows] = core::ranges_with_bits(upright, core::BitBlock::kSide);
        for (std::int64_t x = -(columns.count - 1); x < sheet.columns; ++x) {
            for (std::int64_t y = -(rows.count - 1); y < sheet.rows; ++y) {
                const Cell corner{static_cast<std::uint32_t>(sheet.first.x + x),
                                  static_cast<std::uint32_t>(sheet.first.y + y)};
                const Place place = moved(sheet.code, {corner, sheet.section},
                                          kMiddle - columns.first, kMiddle - rows.first);
                if (quarters == best.quarters && place == best.place) continue;
                const auto [of_x, of_y] = wrong_bits(upright, sheet.code, place);
                sum += std::exp2(-log2_per_bit * (of_x + of_y - wrong));
            }
        }
    }
    return sum;
}

float wrong_at(const core::BitBlock& block, const core::KnownSheets& sheets,
               const core::KnownPlace& at) {
    return core::known_place_wrong(core::kernels(), core::turned(at.quarters, block), sheets,
                                   at.code, at.place);
}

constexpr KnownRegion kSheet{CodeVariant::anoto, {3, 5}, {1000, 2000}, 66, 68};

TEST(KnownPlaces, FindsThePlaceInEveryTurn) {
    Rng rng(kSeed);
    const core::KnownSheets sheets{{&kSheet, 1}, OtherSheets::impossible};
    for (int quarters = 0; quarters < 4; ++quarters) {
        const Cell at{1000 + rng.below(60), 2000 + rng.below(62)};
        const core::BitBlock block = block_of(draw_cells(kSheet, at, 6, 6, 0, 0.05, rng));
        const auto found =
            core::find_known_place(core::kernels(), core::turned(quarters, block), sheets);
        ASSERT_TRUE(found);
        EXPECT_EQ((found->quarters + quarters) % 4, 0);
        const core::BitBlock again = core::turned(found->quarters, core::turned(quarters, block));
        EXPECT_EQ(wrong_bits(again, kSheet.code, found->place), found->wrong);
        EXPECT_EQ(found->wrong, (std::array{0, 0}));
        EXPECT_EQ(found->place.cell, at);
    }
}

TEST(KnownPlaces, ProbabilityIsTheSumOverAllPlaces) {
    Rng rng(kSeed, 1);
    const core::KnownSheets sheets{{&kSheet, 1}, OtherSheets::impossible};
    for (int trial = 0; trial < 5; ++trial) {
        const Cell at{998 + rng.below(60), 1998 + rng.below(62)};
        const int columns = 4 + static_cast<int>(rng.below(3));
        const core::BitBlock block = block_of(draw_cells(kSheet, at, columns, 5, 0.05, 0.1, rng));
        const auto best = core::find_known_place(core::kernels(), block, sheets);
        ASSERT_TRUE(best);
        const double places = 4.0 * (kSheet.columns + 5) * (kSheet.rows + 5);
        const double expected =
            other_odds(block, kSheet, *best) +
            places * random_agreement(best->bits, best->wrong[0] + best->wrong[1]);
        const double wrong = wrong_at(block, sheets, *best);
        EXPECT_GE(wrong, std::min(expected * 0.97, 1.0)) << "trial " << trial;
        EXPECT_LE(wrong, expected * 1.3) << "trial " << trial;
    }
}

TEST(KnownPlaces, UnknownSheetsMayHaveTheSameRows) {
    Rng rng(kSeed, 2);
    const core::BitBlock block = block_of(draw_cells(kSheet, {1010, 2010}, 5, 5, 0, 0, rng));
    const auto wrong_if = [&](OtherSheets others) {
        const core::KnownSheets sheets{{&kSheet, 1}, others};
        const auto best = core::find_known_place(core::kernels(), block, sheets);
        return best ? wrong_at(block, sheets, *best) : 1;
    };
    // The view contains 5 x 5 cells. An unknown sheet may have the same rolls along one axis and,
    // by chance, also the same 25 bits along the other axis. Each axis of the sheet is longer than
    // the period of 63 cells, so two positions on it can have the same roll. The factor of 4 is two
    // axes times two positions.
    EXPECT_GE(wrong_if(OtherSheets::possible), 4 * std::exp2(-25.0));
    EXPECT_LT(wrong_if(OtherSheets::impossible), std::exp2(-25.0));
}

TEST(KnownPlaces, PlacesOnOtherSheetsAreAlternatives) {
    Rng rng(kSeed, 3);
    // The two sheets are a multiple of 63 columns apart, so their rows have the same rolls. Only
    // the x bits distinguish the sheets.
    KnownRegion other = kSheet;
    other.first.x += 630;
    const std::array both{kSheet, other};
    const core::BitBlock block = block_of(draw_cells(kSheet, {1010, 2010}, 2, 16, 0, 0, rng));
    const auto wrong_on = [&](std::span<const KnownRegion> regions) {
        const core::KnownSheets sheets{regions, OtherSheets::impossible};
        const auto best = core::find_known_place(core::kernels(), block, sheets);
        return best ? wrong_at(block, sheets, *best) : 1;
    };
    EXPECT_GT(wrong_on(both), wrong_on({&kSheet, 1}));
}

TEST(KnownPlaces, OverlappingSheetsHaveTheSamePlace) {
    Rng rng(kSeed, 4);
    KnownRegion right = kSheet;
    right.first.x += 10;
    const core::BitBlock block = block_of(draw_cells(kSheet, {1020, 2020}, 6, 6, 0, 0, rng));
    const auto wrong_on = [&](std::span<const KnownRegion> regions) {
        const core::KnownSheets sheets{regions, OtherSheets::impossible};
        const auto best = core::find_known_place(core::kernels(), block, sheets);
        return best ? wrong_at(block, sheets, *best) : 1;
    };
    // On two sheets, there are about twice as many other places as on one sheet.
    const float once = wrong_on({&kSheet, 1});
    const float twice = wrong_on(std::array{kSheet, right});
    EXPECT_GT(twice, once);
    EXPECT_LT(twice, 2.1F * once);
}

}  // namespace
}  // namespace dotpose::core_test::known_places_test
