// Compares the lines of a block with the code, bit by bit, in all orientations.
#include "device/hard_block.hpp"

#include <gtest/gtest.h>

#include "drawn_grid.hpp"

namespace dotpose::core_test::hard_block_test {
namespace {

using core::Axis;

constexpr std::uint64_t kSeed = 4217;
constexpr KnownRegion kSheet{CodeVariant::anoto, {3, 5}, {1000, 2000}, 66, 68};

/// Expects that the lines contain the bits of the code. `at` is the upper left cell of the block.
void expect_code(const core::HardLines& columns, const core::HardLines& rows, Cell at) {
    for (int i = 0; i < columns.count; ++i) {
        for (int j = 0; j < rows.count; ++j) {
            if ((columns[i].seen >> j & 1) == 0) {
                EXPECT_EQ(rows[j].seen >> i & 1, 0U);
                continue;
            }
            const Place place = moved(kSheet.code, {at, kSheet.section}, i, j);
            const Symbol symbol = symbol_at(kSheet.code, place.cell, place.section);
            EXPECT_EQ(static_cast<int>(columns[i].bits >> j & 1), x_bit(symbol));
            EXPECT_EQ(static_cast<int>(rows[j].bits >> i & 1), y_bit(symbol));
        }
    }
}

TEST(HardBlock, HasTheLinesOfEveryOrientation) {
    Rng rng(kSeed);
    for (int quarters = 0; quarters < 4; ++quarters) {
        const Cell at{1010, 2020};
        const Drawing drawing{.columns = 7, .rows = 5, .quarters = quarters, .missing = 0.2};
        const DrawnGrid drawn(kSheet, at, drawing, rng);
        const core::HardBlock block(drawn.grid(), drawn.region());
        const core::HardLines columns = block.lines(Axis::x, quarters);
        const core::HardLines rows = block.lines(Axis::y, quarters);
        ASSERT_EQ(columns.count, 7);
        ASSERT_EQ(rows.count, 5);
        EXPECT_GT(block.dots(), 20);
        EXPECT_LT(block.dots(), 35);
        expect_code(columns, rows, at);
    }
}

TEST(HardBlock, UnclearCellsHaveNoBits) {
    std::vector<GridCell> cells(4, {127, -127, 0});
    cells[1].x = 20;
    cells[2].y = 20;
    core::Grid grid;
    grid.storage = cells;
    grid.columns = grid.rows = 2;
    const core::HardBlock block(grid, {0, 0, 2, 2});
    EXPECT_EQ(block.dots(), 2);
    EXPECT_EQ(block.lines(Axis::x, 0)[0].seen, 1U);
    EXPECT_EQ(block.lines(Axis::x, 0)[1].seen, 2U);
}

TEST(HardBlock, CountsWrongBits) {
    Rng rng(kSeed, 1);
    const Cell at{1030, 2010};
    const DrawnGrid drawn(kSheet, at, {.columns = 6, .rows = 8}, rng);
    drawn.grid().at(2, 3).x = static_cast<std::int8_t>(-drawn.grid().at(2, 3).x);
    const core::HardBlock block(drawn.grid(), drawn.region());
    const auto added = static_cast<std::uint32_t>((kSheet.section.u + at.y) % kSections);
    const core::HardLines columns = block.lines(Axis::x, 0);
    EXPECT_EQ(columns.wrong_at(kSheet.code, at.x, added, 48), 1);
    EXPECT_GT(columns.wrong_at(kSheet.code, at.x + 1, added, 48), 8);
    EXPECT_EQ(columns.wrong_at(kSheet.code, at.x + 1, added, 0) > 0, true);
}

TEST(TrackedBlock, StartsAtTheFirstColumnAndRowWithBits) {
    std::vector<core::ComparedLine> lines(2 * core::kMaxComparedLines);
    // Cells (4, 6) and (5, 9) were read. The x bit of the second cell is wrong.
    lines[4] = {0xFFFFFFFF, 1U << 6, 0};
    lines[5] = {0, 1U << 9, 1U << 9};
    lines[core::kMaxComparedLines + 6] = {0, 1U << 4, 0};
    lines[core::kMaxComparedLines + 9] = {0xFFFFFFFF, 1U << 5, 0};
    const Place corner{{500, 600}, {1, 2}};
    const core::TrackedBlock block(lines, CodeVariant::anoto, corner);
    ASSERT_EQ(block.columns().count, 2);
    ASSERT_EQ(block.rows().count, 4);
    EXPECT_EQ(block.corner().cell, (Cell{504, 606}));
    EXPECT_EQ(block.columns()[0].seen, 1U);
    EXPECT_EQ(block.columns()[0].bits, 1U);
    EXPECT_EQ(block.columns()[1].seen, 8U);
    EXPECT_EQ(block.columns()[1].bits, 8U);
    EXPECT_EQ(block.rows()[0].bits, 0U);
    EXPECT_EQ(block.rows()[3].bits, 2U);
}

}  // namespace
}  // namespace dotpose::core_test::hard_block_test
