#include "device/hard_block.hpp"

namespace dotpose::core {
namespace {

/// A cell is clear if the weights of both its bits have at least this magnitude. Weights are from
/// -127 to 127.
constexpr int kMinWeight = 48;

bool is_clear(const GridCell& cell) {
    return magnitude<int>(cell.x) >= kMinWeight && magnitude<int>(cell.y) >= kMinWeight;
}

std::uint32_t reversed(std::uint32_t word, int count) {
    std::uint32_t result = 0;
    for (int bit = 0; bit < count; ++bit, word >>= 1)
        result = result << 1 | (word & 1);
    return result;
}

/// Turns a block by 180 degrees. `lines` are the lines of the block, with `cells` cells per line.
/// Sets `result` to the lines of the turned block. The turn reverses the order of the lines and of
/// their cells, and inverts all bits.
void turn_over(std::span<const HardLine> lines, int cells, std::span<HardLine> result) {
    HardLine* turned = &result[lines.size() - 1];
    for (const HardLine& line : lines)
        *turned-- = {reversed(~line.bits & line.seen, cells), reversed(line.seen, cells)};
}

/// The range from the first to the last line that contains bits.
struct UsedLines {
    int first;
    int count;
};

UsedLines lines_with_bits(std::span<const ComparedLine> lines) {
    int first = 0;
    int end = static_cast<int>(lines.size());
    while (first < end && lines[static_cast<std::size_t>(first)].seen == 0)
        ++first;
    while (first < end && lines[static_cast<std::size_t>(end - 1)].seen == 0)
        --end;
    return {first, end - first};
}

}  // namespace

int HardLines::wrong_with(const std::uint8_t* rolls, std::uint32_t added, int limit) const {
    int wrong = 0;
    const HardLine* line = first;
    for (int i = count; i > 0 && wrong <= limit; --i, line += step) {
        const std::uint32_t sum = *rolls++ + added;
        wrong += line->wrong_at(sum < kSections ? sum : sum - kSections);
    }
    return wrong;
}

int HardLines::wrong_at(const code::RollsAhead& rolls, std::uint32_t added, int limit) const {
    // In a rotated view, the first and last lines have few bits. Counting starts after the first
    // quarter of the lines, so lines with more bits are counted first, and the count exceeds
    // `limit` sooner.
    const int begin = count / 4;
    int wrong = 0;
    int i = begin;
    do {
        wrong += (*this)[i].wrong_at(rolls.at(static_cast<std::uint32_t>(i), added));
        if (++i == count) i = 0;
    } while (i != begin && wrong <= limit);
    return wrong;
}

HardBlock::HardBlock(const Grid& grid, const GridRegion& region)
    : columns_(region.columns), rows_(region.rows) {
    for (int j = 0; j < rows_; ++j) {
        HardLine& row = row_lines_[0][static_cast<std::size_t>(j)];
        const GridCell* cell = &grid.at(region.i0, region.j0 + j);
        for (int i = 0; i < columns_; ++i, ++cell) {
            if (!is_clear(*cell)) continue;
            HardLine& column = column_lines_[0][static_cast<std::size_t>(i)];
            column.seen |= std::uint32_t{1} << j;
            column.bits |= std::uint32_t{cell->x > 0} << j;
            row.seen |= std::uint32_t{1} << i;
            row.bits |= std::uint32_t{cell->y > 0} << i;
            ++dots_;
        }
    }
    const auto first = [](Lines& lines, int count) {
        return std::span(lines).first(static_cast<std::size_t>(count));
    };
    turn_over(first(column_lines_[0], columns_), rows_, first(column_lines_[1], columns_));
    turn_over(first(row_lines_[0], rows_), columns_, first(row_lines_[1], rows_));
}

HardLines HardBlock::lines(Axis axis, int quarters) const {
    // After a quarter turn, the last row has become the first column, with the same bits. The first
    // column has become the first row, with its bits inverted and in reverse order.
    const bool is_sideways = quarters % 2 == 1;
    const bool are_columns = (axis == Axis::x) != is_sideways;
    const bool is_upside_down = axis == Axis::x ? quarters >= 2 : quarters == 1 || quarters == 2;
    const Lines& lines = (are_columns ? column_lines_ : row_lines_)[is_upside_down ? 1 : 0];
    const int count = are_columns ? columns_ : rows_;
    return is_sideways ? HardLines{&lines[static_cast<std::size_t>(count - 1)], -1, count}
                       : HardLines{lines.data(), 1, count};
}

TrackedBlock::TrackedBlock(std::span<const ComparedLine> lines, CodeVariant code,
                           const Place& corner) {
    const auto all_columns = lines.first(kMaxComparedLines);
    const auto all_rows = lines.last(kMaxComparedLines);
    const UsedLines columns = lines_with_bits(all_columns);
    const UsedLines rows = lines_with_bits(all_rows);
    const auto take = [](std::span<const ComparedLine> all, UsedLines used, int first_cell,
                         std::span<HardLine> result) {
        for (int i = 0; i < used.count; ++i) {
            const ComparedLine& line = all[static_cast<std::size_t>(used.first + i)];
            result[static_cast<std::size_t>(i)] = {
                ((line.code ^ line.wrong) & line.seen) >> first_cell, line.seen >> first_cell};
        }
    };
    // If no bits were read, `columns` and `rows` are empty, so `first_cell` is not used.
    take(all_columns, columns, rows.first, columns_);
    take(all_rows, rows, columns.first, rows_);
    column_count_ = columns.count;
    row_count_ = rows.count;
    corner_ = moved(code, corner, columns.first, rows.first);
}

}  // namespace dotpose::core
