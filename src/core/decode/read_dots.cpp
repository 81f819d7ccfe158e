#include "core/decode/read_dots.hpp"

#include <algorithm>

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

/// Notes what is read; whether it is what the code has there.
bool note(const Tracking& tracking, int i, int j, const Projections& p) {
    TrackedLine& column = column_of(tracking, i);
    TrackedLine& row = row_of(tracking, j);
    const auto in_column = std::uint32_t{1} << j;
    const auto in_row = std::uint32_t{1} << i;
    column.seen |= in_column;
    row.seen |= in_row;
    const bool is_x_wrong = ((column.code & in_column) != 0) != (p.x_q12 > 0);
    const bool is_y_wrong = ((row.code & in_row) != 0) != (p.y_q12 > 0);
    if (is_x_wrong) column.wrong |= in_column;
    if (is_y_wrong) row.wrong |= in_row;
    return !is_x_wrong && !is_y_wrong;
}

/// Whether a bit can be told from a projection: between a quarter of the displacement and 7/4.
bool is_clear(std::int32_t length_q12, std::int32_t displacement_q12) {
    return 4 * length_q12 >= displacement_q12 && 4 * length_q12 <= 7 * displacement_q12;
}

/// Whether the dot is what the code has there.
bool read_dot(Tracking& tracking, int i, int j, const NearDot& dot) {
    const Projections p = projections(tracking, dot.from_intersection_q8);
    const std::int32_t x_q12 = magnitude(p.x_q12);
    const std::int32_t y_q12 = magnitude(p.y_q12);
    const std::int32_t displacement_q12 = tracking.displacement_q12;
    if (!is_clear(x_q12, displacement_q12) || !is_clear(y_q12, displacement_q12)) return false;
    if (!note(tracking, i, j, p)) return false;
    tracking.projections_q12 += x_q12 + y_q12;
    return true;
}

}  // namespace

void begin_reading(Tracking& tracking) {
    const Way way = way_of(tracking);
    const int half = tracking.half_px;
    const std::int32_t least_q16 = half * 65536 - 32768;
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
}

void read_ready_dots(Tracking& tracking, std::span<Dot> dots, int& dot_count, Fix& fix) {
    const Way way = way_of(tracking);
    const std::int32_t ready_q16 =
        (tracking.rows_taken - 1 - tracking.half_px) * 65536 + 32767;
    const std::size_t room = std::min(dots.size(), tracking.dot_cells.size());
    for (int j = tracking.first_cell; j <= tracking.last_cell; ++j) {
        TrackedRow& row = tracking.grid_rows[static_cast<std::size_t>(j)];
        for (; row.left > 0 && row.next_q16.y <= ready_q16; --row.left) {
            const Vec at_q16 = row.next_q16;
            const int i = row.i;
            row.next_q16 = at_q16 + way.step_q16;
            row.i = static_cast<std::int8_t>(i + way.i_step);
            NearDot dot;
            if (!measure_near_dot(tracking, at_q16, dot)) continue;
            ++fix.dots_seen;
            const auto count = static_cast<std::size_t>(dot_count);
            if (!read_dot(tracking, i, j, dot) || count == room) continue;
            dots[count] = {dot.from_intersection_q8 + Vec{at_q16.x >> 8, at_q16.y >> 8},
                           static_cast<std::uint16_t>(dot.mass), 0};
            tracking.dot_cells[count] = static_cast<std::uint16_t>(j * kMostTracked + i);
            ++dot_count;
        }
    }
}

}  // namespace dotpose::core
