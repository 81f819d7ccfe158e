#include "core/decode/read_dots.hpp"

#include <algorithm>

#include "core/by_itself.hpp"
#include "core/detect/near_dot.hpp"
#include "core/fixed.hpp"
#include "core/lattice/coded_cells.hpp"
#include "core/lattice/predicted.hpp"

namespace dotpose::core {
namespace {

/// The way along a row of cells on which the image's rows come later.
struct Way {
    Vec step_q16;
    std::int8_t i_step;
};
Way way_of(const Tracking& tracking) {
    const Vec along = tracking.cells.along_x_q16;
    return along.y < 0 ? Way{-along, -1} : Way{along, 1};
}

/// Notes what is read; whether the code has it there.
DOTPOSE_BY_ITSELF bool note(const Tracking& tracking, int i, int j, int symbol) {
    TrackedLine& column = column_of(tracking, i);
    TrackedLine& row = row_of(tracking, j);
    const auto in_column = std::uint32_t{1} << j;
    const auto in_row = std::uint32_t{1} << i;
    column.seen |= in_column;
    row.seen |= in_row;
    const int coded = (column.code >> j & 1) + (row.code >> i & 1) * 2;
    if (coded == symbol) return true;
    const int wrong = coded ^ symbol;
    if ((wrong & 1) != 0) column.wrong |= in_column;
    if ((wrong & 2) != 0) row.wrong |= in_row;
    return false;
}

/// Measures the dot that the code has at an intersection; whether it is where it should be.
DOTPOSE_BY_ITSELF bool measure_dot(Tracking& tracking, Vec at_q16, const ReadSymbol& read,
                                   Dot& dot) {
    const Vec displaced_q16 = tracking.displaced_q16[static_cast<std::size_t>(read.symbol)];
    const Vec place_q16 = at_q16 + displaced_q16;
    NearDot near;
    if (!measure_square<kDotHalf_px>(tracking, place_q16, read.level, near)) return false;
    // Printers and lenses rarely move a dot by more than an eighth of the spacing; dirt does.
    if (!is_within(near.off_q8, tracking.spacing_q8 >> 3)) return false;
    tracking.along_q16 +=
        near.off_q8.x * (displaced_q16.x >> 8) + near.off_q8.y * (displaced_q16.y >> 8);
    dot = {near.off_q8 + Vec{place_q16.x >> 8, place_q16.y >> 8},
           static_cast<std::uint16_t>(near.mass), 0};
    return true;
}

}  // namespace

bool begin_reading(Tracking& tracking) {
    if (!lay_dot_pixels(tracking)) return false;
    const Way way = way_of(tracking);
    constexpr int half = kHalf_px;
    const std::int32_t least_q16 = half * 65536;
    const auto width_q16 = static_cast<std::uint32_t>(tracking.width_px - 2 * half) << 16;
    const auto height_q16 = static_cast<std::uint32_t>(tracking.height_px - 2 * half) << 16;
    const int first = way.i_step > 0 ? tracking.first_cell : tracking.last_cell;
    const int cells = tracking.last_cell - tracking.first_cell + 1;
    for (int j = tracking.first_cell; j <= tracking.last_cell; ++j) {
        // Those in view stand side by side.
        Vec at_q16 = place_q16(tracking.cells, first, j) - Vec{least_q16, least_q16};
        const auto is_in_view = [&] {
            return static_cast<std::uint32_t>(at_q16.x) < width_q16 &&
                   static_cast<std::uint32_t>(at_q16.y) < height_q16;
        };
        int before = 0;
        for (; before < cells && !is_in_view(); ++before)
            at_q16 = at_q16 + way.step_q16;
        TrackedRow& row = tracking.grid_rows[static_cast<std::size_t>(j)];
        row.next_q16 = at_q16 + Vec{least_q16, least_q16};
        row.i = static_cast<std::int8_t>(first + way.i_step * before);
        row.left = 0;
        for (; before < cells && is_in_view(); ++before) {
            at_q16 = at_q16 + way.step_q16;
            ++row.left;
        }
    }
    return true;
}

void read_ready_dots(Tracking& tracking, std::span<Dot> dots, int& dot_count) {
    const Way way = way_of(tracking);
    // A dot may reach a row farther than its square; the last row of all is always ready.
    const int ahead = tracking.rows_taken == tracking.height_px ? 1 : 2;
    const std::int32_t ready_q16 = (tracking.rows_taken - ahead - kHalf_px) * 65536 + 32767;
    const auto room = std::min(dots.size(), tracking.dot_cells.size());
    auto count = static_cast<std::size_t>(dot_count);
    TrackedRow* row = &tracking.grid_rows[static_cast<std::size_t>(tracking.first_cell)];
    for (int j = tracking.first_cell; j <= tracking.last_cell; ++j, ++row) {
        for (; row->left > 0 && row->next_q16.y <= ready_q16 && count < room; --row->left) {
            const Vec at_q16 = row->next_q16;
            const int i = row->i;
            row->next_q16 = at_q16 + way.step_q16;
            row->i = static_cast<std::int8_t>(i + way.i_step);
            const ReadSymbol read = read_symbol(tracking, at_q16);
            if (read.symbol < 0 || !note(tracking, i, j, read.symbol) ||
                !measure_dot(tracking, at_q16, read, dots[count]))
                continue;
            tracking.dot_cells[count++] = static_cast<std::uint16_t>(j * kMostTracked + i);
        }
    }
    dot_count = static_cast<int>(count);
}

}  // namespace dotpose::core
