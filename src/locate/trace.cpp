#include "locate/trace.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/decode/window.hpp"

namespace dotpose::core {
namespace {

FixedVec cell_of(const MeasuredDots& dots, std::size_t k) {
    return {static_cast<std::int32_t>(dots.column[k]), static_cast<std::int32_t>(dots.row[k])};
}

/// Returns true if the dot was found, and its cell is at most `reach` cells from cell (0, 0).
bool is_found_within(const MeasuredDots& dots, std::size_t k, int reach) {
    return dots.x[k] < kNoDot_px && is_within(cell_of(dots, k), reach);
}

/// Returns the maximum distance from cell (0, 0) at which the grid stores cells.
int reach_of(const Grid& grid) {
    return (std::min(grid.side, kMaxGridSide) - 1) / 2;
}

/// Clears the grid and sets its size to the cells of the dots that were found.
void clear_grid(const MeasuredDots& dots, Grid& grid) {
    FixedVec first{INT32_MAX, INT32_MAX};
    FixedVec last{INT32_MIN, INT32_MIN};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        if (!is_found_within(dots, k, reach_of(grid))) continue;
        const FixedVec cell = cell_of(dots, k);
        first = {std::min(first.x, cell.x), std::min(first.y, cell.y)};
        last = {std::max(last.x, cell.x), std::max(last.y, cell.y)};
    }
    grid.i0 = first.x;
    grid.j0 = first.y;
    grid.columns = last.x - first.x + 1;
    grid.rows = last.y - first.y + 1;
    std::fill_n(grid.storage.begin(), grid.columns * grid.rows, GridCell{});
}

/// Returns the centre and the mass of a dot. `centre_q8` is the centre of the plane.
DetectedDot detected(const MeasuredDots& dots, std::size_t k, FixedVec centre_q8) {
    DetectedDot dot;
    dot.centre_q8 =
        centre_q8 + FixedVec{static_cast<std::int32_t>(std::floor(dots.x[k] * 256 + 0.5F)),
                             static_cast<std::int32_t>(std::floor(dots.y[k] * 256 + 0.5F))};
    dot.mass = static_cast<std::uint16_t>(std::min<std::int32_t>(dots.mass[k], 65535));
    dot.area_px = 0;
    return dot;
}

/// Returns the cell of a dot, with the weights of its bits.
GridCell cell_with_bits(const MeasuredDots& dots, std::size_t k, const Hypothesis& hypothesis,
                        int dot_index) {
    const FloatVec at = plane_point(hypothesis.pattern_from_image, {dots.x[k], dots.y[k]});
    const float off_x = at.x - dots.column[k];
    const float off_y = at.y - dots.row[k];
    const auto weight = [&](float clear) {
        return static_cast<std::int8_t>(
            std::clamp(127 * clear / hypothesis.displacement, -127.0F, 127.0F));
    };
    return {weight(off_y - off_x), weight(off_y + off_x), static_cast<std::uint16_t>(dot_index)};
}

/// Stores the dots in `found`, up to its capacity, and their bits in the grid. Returns the number
/// of stored dots.
int store_dots(const Measurement& measurement, Grid& grid, std::span<DetectedDot> found) {
    const MeasuredDots& dots = measurement.dots;
    const FixedVec centre_q8 = measurement.pattern_from_image.centre_q8;
    clear_grid(dots, grid);
    int count = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        if (count == static_cast<int>(found.size())) break;
        if (!is_found_within(dots, k, reach_of(grid))) continue;
        found[static_cast<std::size_t>(count)] = detected(dots, k, centre_q8);
        const FixedVec cell = cell_of(dots, k);
        grid.at(cell.x, cell.y) = cell_with_bits(dots, k, measurement.hypothesis, count);
        ++count;
    }
    return count;
}

}  // namespace

void store_for_trace(const Measurement& measurement, bool with_dots, Workspace& w) {
    w.pattern_from_image = measurement.pattern_from_image;
    w.decoding.place = measurement.hypothesis.place;
    w.decoding.pattern_from_grid = {};
    w.decoding.bits = measurement.bits;
    if (!with_dots) return;
    w.dot_count = store_dots(measurement, w.grid, w.dots);
    w.decoding.region = {w.grid.i0, w.grid.j0, w.grid.columns, w.grid.rows};
    w.decoding.window = choose_window(w.grid, kWindowSide);
    w.grid_from_image = measurement.pattern_from_image;
}

}  // namespace dotpose::core
