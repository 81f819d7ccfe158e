// Tests coded blocks cell by cell against the encoder.
#include "core/integrity/coded_block.hpp"

#include <bit>

#include <gtest/gtest.h>

#include "code/rolls.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::coded_block_test {
namespace {

constexpr std::uint64_t kSeed = 4021;

/// The cells around cell (0, 0), which is at a given place in the code. The first column and the
/// first row have the index kFirst.
struct Seen {
    static constexpr int kFirst = -20;
    static constexpr int kCount = 41;
    std::array<std::uint8_t, kCount> column_rolls;
    std::array<std::uint8_t, kCount> row_rolls;
    core::CellsInView view;
    core::BitBlock block;

    explicit Seen(const Place& place) {
        const Place corner = moved(CodeVariant::anoto, place, kFirst, kFirst);
        const auto follow = [](std::uint32_t position, int section, std::uint32_t cross,
                               std::span<std::uint8_t> rolls) {
            code::follow_rolls(CodeVariant::anoto, position, section, cross, rolls);
        };
        follow(corner.cell.x, corner.section.u, corner.cell.y, column_rolls);
        follow(corner.cell.y, corner.section.v, corner.cell.x, row_rolls);
        view.column_rolls = column_rolls.data();
        view.row_rolls = row_rolls.data();
        view.first_column = view.first_row = kFirst;
        view.columns = view.rows = kCount;
    }
    void show(int column, int row, bool x, bool y) {
        const auto i = static_cast<std::size_t>(core::BitBlock::kMiddle + column);
        const auto j = static_cast<std::size_t>(core::BitBlock::kMiddle + row);
        block.columns.valid[i] |= std::uint64_t{1} << j;
        block.columns.bits[i] |= std::uint64_t{x} << j;
        block.rows.valid[j] |= std::uint64_t{1} << i;
        block.rows.bits[j] |= std::uint64_t{y} << i;
    }
};

Place any_place(Rng& rng) {
    return {{rng.below(kPositionsPerAxis), rng.below(kPositionsPerAxis)},
            {static_cast<std::uint8_t>(rng.below(63)), static_cast<std::uint8_t>(rng.below(63))}};
}

TEST(CodedBlock, HasTheCodesBitsInTheMiddleAndWhichAreWrong) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "place " << i << ", seed " << kSeed);
        const Place place = any_place(rng);
        Seen seen(place);
        constexpr int kWrongColumn = 3;
        constexpr int kWrongRow = -2;
        for (int row = -18; row < 19; ++row) {
            for (int column = -7; column < 9; ++column) {
                const Place at = moved(CodeVariant::anoto, place, column, row);
                const Symbol symbol = symbol_at(CodeVariant::anoto, at.cell, at.section);
                const bool is_wrong = column == kWrongColumn && row == kWrongRow;
                seen.show(column, row, (x_bit(symbol) != 0) != is_wrong, y_bit(symbol) != 0);
            }
        }
        const core::CodedBlock coded(CodeVariant::anoto, place, seen.view, seen.block);
        const core::AxisBits x = coded.axis(core::Axis::x, {});
        const core::AxisBits y = coded.axis(core::Axis::y, {});
        // A line holds at most 32 cells, starting at cell -16, so only 32 of the 37 rows are kept.
        ASSERT_EQ(x.lines.size(), 16U);
        ASSERT_EQ(y.lines.size(), 32U);
        EXPECT_EQ(x.reading.position, moved(CodeVariant::anoto, place, -7, 0).cell.x);
        EXPECT_EQ(y.reading.position, moved(CodeVariant::anoto, place, 0, -16).cell.y);
        for (std::size_t line = 0; line < x.lines.size(); ++line) {
            EXPECT_EQ(x.lines[line].seen, ~std::uint32_t{0});
            const bool is_wrong = static_cast<int>(line) - 7 == kWrongColumn;
            EXPECT_EQ(x.lines[line].wrong, is_wrong ? 1U << (kWrongRow + 16) : 0U) << line;
        }
        for (const core::ComparedLine& line : y.lines) {
            EXPECT_EQ(line.seen, 0xFFFFU << 9);
            EXPECT_EQ(line.wrong, 0U);
        }
    }
}

TEST(CodedBlock, KeepsTheLongestStretchOfLinesWithGapsUnlessABitIsWrong) {
    Rng rng(kSeed);
    const Place place = any_place(rng);
    for (const bool is_wrong : {false, true}) {
        Seen seen(place);
        for (const int row : {-9, -8, -5, -4, -3, -2, 4, 5, 6}) {
            const Place at = moved(CodeVariant::anoto, place, 0, row);
            const Symbol symbol = symbol_at(CodeVariant::anoto, at.cell, at.section);
            seen.show(0, row, (x_bit(symbol) != 0) != (is_wrong && row == 5), y_bit(symbol) != 0);
        }
        const core::CodedBlock coded(CodeVariant::anoto, place, seen.view, seen.block);
        const core::AxisBits x = coded.axis(core::Axis::x, {});
        ASSERT_EQ(x.lines.size(), 1U);
        EXPECT_EQ(std::popcount(x.lines[0].seen), is_wrong ? 9 : 4);
        if (!is_wrong) {
            EXPECT_EQ(x.lines[0].seen, 15U << 11);
        }
        EXPECT_EQ(x.lines[0].wrong, is_wrong ? 1U << 21 : 0U);
    }
}

}  // namespace
}  // namespace dotpose::core_test::coded_block_test
