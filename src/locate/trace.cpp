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

/// Calls `use(k, cell)` for each found dot `k` whose cell fits in the grid.
template <typename Use>
void visit_dots(const MeasuredDots& dots, int grid_side, Use use) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        const FixedVec cell = cell_of(dots, k);
        if (dots.x[k] < kNoDot_px && is_within(cell, (std::min(grid_side, kMaxGridSide) - 1) / 2))
            use(k, cell);
    }
}

/// Clears the grid, and resizes it to cover the cells of all dots that were found.
void clear_grid(const MeasuredDots& dots, Grid& grid) {
    FixedVec first{INT32_MAX, INT32_MAX};
    FixedVec last{INT32_MIN, INT32_MIN};
    visit_dots(dots, grid.side, [&](std::size_t, FixedVec cell) {
        first = {std::min(first.x, cell.x), std::min(first.y, cell.y)};
        last = {std::max(last.x, cell.x), std::max(last.y, cell.y)};
    });
    grid.i0 = first.x;
    grid.j0 = first.y;
    grid.columns = last.x - first.x + 1;
    grid.rows = last.y - first.y + 1;
    std::fill_n(grid.storage.begin(), grid.columns * grid.rows, GridCell{});
}

/// Stores the dots in `found`, up to its capacity, and their bits in the grid. Returns the number
/// of stored dots.
int store_dots(const Measurement& measurement, Grid& grid, std::span<DetectedDot> found) {
    const MeasuredDots& dots = measurement.dots;
    const Hypothesis& hypothesis = measurement.hypothesis;
    std::size_t count = 0;
    clear_grid(dots, grid);
    const auto weight = [&](float clear) {
        return static_cast<std::int8_t>(
            std::clamp(127 * clear / hypothesis.displacement, -127.0F, 127.0F));
    };
    const auto q8 = [](float px) { return static_cast<std::int32_t>(std::floor(px * 256 + 0.5F)); };
    visit_dots(dots, grid.side, [&](std::size_t k, FixedVec cell) {
        if (count == found.size()) return;
        DetectedDot& dot = found[count];
        dot.centre_q8 =
            measurement.pattern_from_image.centre_q8 + FixedVec{q8(dots.x[k]), q8(dots.y[k])};
        dot.mass = static_cast<std::uint16_t>(std::min<std::int32_t>(dots.mass[k], 65535));
        dot.area_px = 0;
        const FloatVec at = plane_point(hypothesis.pattern_from_image, {dots.x[k], dots.y[k]});
        const float off_x = at.x - dots.column[k];
        const float off_y = at.y - dots.row[k];
        grid.at(cell.x, cell.y) = {weight(off_y - off_x), weight(off_y + off_x),
                                   static_cast<std::uint16_t>(count)};
        ++count;
    });
    return static_cast<int>(count);
}

}  // namespace

void store_for_trace(const Measurement& measurement, bool with_dots, Workspace& w) {
    w.pattern_from_image = measurement.pattern_from_image;
    w.decoding.place = measurement.hypothesis.place;
    w.decoding.pattern_from_grid = {};
    w.decoding.bits = measurement.compared.count;
    if (!with_dots) return;
    w.dot_count = store_dots(measurement, w.grid, w.dots);
    w.decoding.region = {w.grid.i0, w.grid.j0, w.grid.columns, w.grid.rows};
    w.decoding.window = choose_window(w.grid, kWindowSide);
    w.grid_from_image = measurement.pattern_from_image;
}

}  // namespace dotpose::core
