// Tests the rotation and the decoding of blocks of bits. The blocks are generated with `symbol_at`.
#include "core/decode/bit_lines.hpp"

#include <gtest/gtest.h>

#include "../geometry.hpp"
#include "code/tables.hpp"
#include "core/decode/exact_lines.hpp"
#include "core/kernels/select.hpp"
#include "core/math/fixed.hpp"

namespace dotpose::core_test::bit_lines_test {
namespace {

using core::BitBlock;
using core::operator-;
using core_test::operator-;

constexpr std::uint64_t kSeed = 76;

/// Returns the cell to which `core::turned` must move a cell of a block.
FixedVec cell_turned(int quarters, FixedVec cell) {
    switch (quarters) {
        case 1:
            return {-1 - cell.y, cell.x};
        case 2:
            return {-1 - cell.x, -1 - cell.y};
        case 3:
            return {cell.y, -1 - cell.x};
        default:
            return cell;
    }
}

struct Damage {
    double missing = 0;
    double flipped = 0;
};

void set_bit(core::BitLines& lines, int line, int cell, bool value) {
    const auto at = static_cast<std::size_t>(line + BitBlock::kMiddle);
    const std::uint64_t bit = std::uint64_t{1} << (cell + BitBlock::kMiddle);
    lines.valid[at] |= bit;
    if (value) lines.bits[at] |= bit;
}

/// Returns the bits of the cells from `least` to `most` - 1, as a camera rotated by `quarters`
/// quarter turns sees them. The displacement of each dot from its intersection is also rotated.
BitBlock seen_block(CodeVariant code, const Place& zero, int quarters, FixedVec least,
                    FixedVec most, const Damage& damage, Rng& rng) {
    BitBlock block;
    const QuarterTurn back = QuarterTurn{quarters}.inverse();
    for (int j = least.y; j < most.y; ++j) {
        for (int i = least.x; i < most.x; ++i) {
            const FixedVec cell = cell_turned(quarters, {i, j});
            const Place at = moved(code, zero, cell.x, cell.y);
            const Symbol symbol = symbol_at(code, at.cell, at.section);
            const FixedVec seen = back({dx(symbol), dy(symbol)});
            if (rng.uniform() < damage.missing) continue;
            // A dot displaced to the right or down has y bit 1. A dot displaced to the left or down
            // has x bit 1.
            const bool y = seen.x + seen.y > 0;
            const bool x = seen.y - seen.x > 0;
            set_bit(block.columns, i, j, x != (rng.uniform() < damage.flipped));
            set_bit(block.rows, j, i, y != (rng.uniform() < damage.flipped));
        }
    }
    return block;
}

void expect_same(const BitBlock& a, const BitBlock& b) {
    for (std::size_t i = 0; i < 64; ++i) {
        ASSERT_EQ(a.columns.valid[i], b.columns.valid[i]) << i;
        ASSERT_EQ(a.rows.valid[i], b.rows.valid[i]) << i;
        ASSERT_EQ(a.columns.bits[i] & a.columns.valid[i], b.columns.bits[i] & b.columns.valid[i]);
        ASSERT_EQ(a.rows.bits[i] & a.rows.valid[i], b.rows.bits[i] & b.rows.valid[i]);
    }
}

/// Returns a random place. Three out of four places are near an end of the code.
Place some_place(int i, Rng& rng) {
    Place place = random_place(rng);
    if (i % 4 == 1) place.cell.x = i % 8 == 1 ? 3 : kPositionsPerAxis - 4;
    if (i % 4 == 2) place.cell.y = i % 8 == 2 ? 2 : kPositionsPerAxis - 1;
    if (i % 4 == 3) place.cell = {kPositionsPerAxis - 2, 1};
    return place;
}

TEST(BitLines, ABlockTurnsAsTheCodeDoes) {
    Rng rng(kSeed);
    for (int i = 0; i < 48; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        const int quarters = i / 3 % 4;
        const Place zero = some_place(i, rng);
        const FixedVec least{-static_cast<int>(rng.below(33)), -static_cast<int>(rng.below(33))};
        const FixedVec most{1 + static_cast<int>(rng.below(31)),
                            1 + static_cast<int>(rng.below(31))};
        const BitBlock seen = seen_block(code, zero, quarters, least, most, {}, rng);
        // The block that a camera without rotation reads from the same cells.
        const FixedVec a = cell_turned(quarters, least);
        const FixedVec b = cell_turned(quarters, most - FixedVec{1, 1});
        const BitBlock upright =
            seen_block(code, zero, 0, {std::min(a.x, b.x), std::min(a.y, b.y)},
                       {std::max(a.x, b.x) + 1, std::max(a.y, b.y) + 1}, {}, rng);
        expect_same(core::turned(quarters, seen), upright);
    }
}

TEST(BitLines, APlaneTurnsAsItsCellsDo) {
    Rng rng(kSeed);
    core::FloatPlane plane{1.25F, -2.5F, 0.1F, 0.02F, -0.02F, 0.1F, 1e-4F, -2e-4F, 1e-6F};
    for (int quarters = 0; quarters < 4; ++quarters) {
        const core::FloatPlane turned = core::turned(quarters, plane);
        const auto at = [](const core::FloatPlane& p, float x, float y) {
            const float over = 1 / (1 + p.tilt_x * x + p.tilt_y * y + p.bend * (x * x + y * y));
            return Vec2{double{p.at_x + (p.du_x * x + p.dv_x * y) * over},
                        double{p.at_y + (p.du_y * x + p.dv_y * y) * over}};
        };
        for (int k = 0; k < 20; ++k) {
            const auto x = static_cast<float>(rng.uniform(-90, 90));
            const auto y = static_cast<float>(rng.uniform(-60, 60));
            const Vec2 before = at(plane, x, y);
            // The plane must be rotated in the same way as the cells.
            const FixedVec zero = cell_turned(quarters, {});
            const FixedVec right = cell_turned(quarters, {1, 0}) - zero;
            const FixedVec down = cell_turned(quarters, {0, 1}) - zero;
            const Vec2 expected{zero.x + before.x * right.x + before.y * down.x,
                                zero.y + before.x * right.y + before.y * down.y};
            EXPECT_LT(length(at(turned, x, y) - expected), 1e-4);
        }
    }
}

struct Found {
    int blocks = 0;
    int turns = 0;
    int places = 0;
    int exactly = 0;
};

/// Returns how many of `blocks` random blocks are found. Expects that no block is found at a wrong
/// place.
Found find_blocks(int blocks, int min_side, const Damage& damage, const core::Kernels& kernels) {
    Rng rng(kSeed);
    Found found;
    std::array<ScoredLine, 2 * kMaxLines> storage;
    for (int i = 0; i < blocks; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        const int quarters = i / 3 % 4;
        const Place zero = some_place(i, rng);
        const auto half = [&] { return (min_side + static_cast<int>(rng.below(12))) / 2; };
        const FixedVec least{-half(), -half()};
        const FixedVec most{half(), half()};
        const BitBlock seen = seen_block(code, zero, quarters, least, most, damage, rng);
        ++found.blocks;
        const int turn = core::likeliest_turn(kernels, seen);
        found.turns += turn == quarters;
        if (turn != quarters) continue;
        const core::BlockLines lines =
            core::score_block(kernels, core::turned(turn, seen), storage);
        Place place;
        if (!core::find_place(code, lines, place)) continue;
        EXPECT_EQ(place, zero);
        ++found.places;
        if (!core::find_place_exactly(code, core::turned(turn, seen), place)) continue;
        EXPECT_EQ(place, zero);
        ++found.exactly;
    }
    return found;
}

TEST(BitLines, BlocksAreFoundAtEveryTurnAnywhere) {
    for (const core::Kernels* kernels : {&core::portable_kernels(), &core::kernels()}) {
        const Found found = find_blocks(120, 16, {}, *kernels);
        EXPECT_EQ(found.turns, found.blocks);
        EXPECT_EQ(found.places, found.blocks);
        EXPECT_EQ(found.exactly, found.blocks);
    }
}

TEST(BitLines, DamagedBlocksAreFound) {
    const Found found = find_blocks(240, 18, {0.2, 0.03}, core::kernels());
    EXPECT_GE(found.turns, found.blocks * 99 / 100);
    EXPECT_GE(found.places, found.blocks * 95 / 100);
}

TEST(BitLines, HardlyDamagedBlocksAreOftenFoundExactly) {
    const Found found = find_blocks(240, 18, {0.03, 0.003}, core::kernels());
    EXPECT_GT(found.exactly, found.blocks / 3);
    EXPECT_LT(found.exactly, found.blocks);
}

TEST(BitLines, OneWrongBitMakesALineInexact) {
    Rng rng(kSeed);
    for (int i = 0; i < 500; ++i) {
        SCOPED_TRACE(testing::Message() << "line " << i << ", seed " << kSeed);
        const auto roll = static_cast<unsigned>(rng.below(63));
        const auto first = static_cast<int>(rng.below(48));
        const int last = std::min(first + 15 + static_cast<int>(rng.below(48)), 63);
        std::uint64_t bits = rng.bits();
        std::uint64_t valid = 0;
        for (int cell = first; cell <= last; ++cell) {
            const std::uint64_t here = std::uint64_t{1} << cell;
            const bool bit = main_bit(roll + static_cast<unsigned>(cell)) == 1;
            bits = bit ? bits | here : bits & ~here;
            // Six adjacent bits are needed to determine the roll, so the first six bits are always
            // present. Any other bit may be missing.
            if (cell < first + 6 || rng.below(8) != 0) valid |= here;
        }
        EXPECT_EQ(core::exact_roll(bits, valid), roll);
        const std::uint64_t wrong = std::uint64_t{1} << (first + static_cast<int>(rng.below(6)));
        EXPECT_NE(core::exact_roll(bits ^ wrong, valid), roll);
        EXPECT_EQ(core::exact_roll(bits, valid & ~(valid << 1) & ~(valid >> 1)), code::kAbsent);
        EXPECT_EQ(core::exact_roll(bits, 0), code::kAbsent);
    }
}

TEST(BitLines, LinesOfTwoPlacesAreNotOnePlace) {
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        BitBlock block = seen_block(code, some_place(i, rng), 0, {-8, -8}, {8, 8}, {}, rng);
        const BitBlock other = seen_block(code, random_place(rng), 0, {-8, -8}, {8, 8}, {}, rng);
        // The first four columns belong to another place, so the lines do not agree on one place.
        for (std::size_t line = 24; line < 28; ++line)
            block.columns.bits[line] = other.columns.bits[line];
        Place place;
        EXPECT_FALSE(core::find_place_exactly(code, block, place));
    }
}

TEST(BitLines, FewLinesSpellNoPlace) {
    Rng rng(kSeed);
    std::array<ScoredLine, 2 * kMaxLines> storage;
    const Place zero = random_place(rng);
    for (const FixedVec most : {FixedVec{5, 12}, FixedVec{12, 5}, FixedVec{1, 1}}) {
        const BitBlock block = seen_block(CodeVariant::anoto, zero, 0, {0, 0}, most, {}, rng);
        Place place;
        EXPECT_FALSE(core::find_place(CodeVariant::anoto,
                                      core::score_block(core::kernels(), block, storage), place));
    }
    Place place;
    EXPECT_FALSE(core::find_place(CodeVariant::anoto,
                                  core::score_block(core::kernels(), BitBlock{}, storage), place));
    EXPECT_EQ(core::turned(core::likeliest_turn(core::kernels(), BitBlock{}), BitBlock{})
                  .columns.valid[0],
              0U);
}

TEST(BitLines, MoreLinesThanThereIsRoomForAreThoseAroundTheMiddle) {
    Rng rng(kSeed);
    std::array<ScoredLine, 2 * 24> storage;
    const Place zero = random_place(rng);
    const BitBlock block = seen_block(CodeVariant::anoto, zero, 0, {-30, -25}, {30, 31}, {}, rng);
    const core::BlockLines lines = core::score_block(core::kernels(), block, storage);
    EXPECT_EQ(lines.columns.count(), 24);
    EXPECT_EQ(lines.rows.count(), 24);
    EXPECT_EQ(lines.first_column, BitBlock::kMiddle - 12);
    EXPECT_EQ(lines.first_row, BitBlock::kMiddle - 12);
    Place place;
    ASSERT_TRUE(core::find_place(CodeVariant::anoto, lines, place));
    EXPECT_EQ(place, zero);
}

}  // namespace
}  // namespace dotpose::core_test::bit_lines_test
