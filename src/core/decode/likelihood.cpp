#include "core/decode/likelihood.hpp"

#include "core/math/cells.hpp"

namespace dotpose::core {
namespace {

struct Extent {
    int first = 0;
    int count = 0;
};

/// Returns the range of cells from `min` to `max`. If the range has more than `capacity` cells,
/// keeps the cells nearest the origin.
Extent extent(int min, int max, int capacity) {
    if (max - min < capacity) return {min, max - min + 1};
    const int first = std::clamp(-capacity / 2, min, max - capacity + 1);
    return {first, capacity};
}

}  // namespace

void lay_out(FixedVec min, FixedVec max, Grid& grid) {
    const Extent columns = extent(min.x, max.x, grid.side);
    const Extent rows = extent(min.y, max.y, grid.side);
    grid.i0 = columns.first;
    grid.columns = columns.count;
    grid.j0 = rows.first;
    grid.rows = rows.count;
    std::fill_n(grid.storage.begin(), grid.columns * grid.rows, GridCell{});
}

std::int8_t quasi_probability(std::int32_t projection_q16) {
    // The paper's r0 is a dot's nominal displacement, a sixth of the spacing.
    const int r_q8 = (projection_q16 * 6 + 128) >> 8;  // r / r0
    const int square_q16 = r_q8 * r_q8;
    if (square_q16 >= 3 * 65536) return 0;
    // f = (3 r - r^3) / 2, with r in units of r0 (paper, equation 9).
    const int f_q8 = (r_q8 * (3 * 65536 - square_q16)) >> 17;
    return static_cast<std::int8_t>((f_q8 * 127 + 128) >> 8);
}

namespace {

/// Fills the grid. `point_of(dot)` returns the cell nearest the dot, and the dot's offset from that
/// cell's intersection.
template <typename PointOf>
Status assign(std::span<const DetectedDot> dots, int min_side, PointOf point_of, Grid& grid) {
    FixedVec min{INT32_MAX, INT32_MAX};
    FixedVec max{INT32_MIN, INT32_MIN};
    for (const DetectedDot& dot : dots) {
        const FixedVec cell = point_of(dot).cell;
        min = {std::min(min.x, cell.x), std::min(min.y, cell.y)};
        max = {std::max(max.x, cell.x), std::max(max.y, cell.y)};
    }
    if (dots.empty() || max.x - min.x + 1 < min_side || max.y - min.y + 1 < min_side) {
        return Status::grid_too_small;
    }
    lay_out(min, max, grid);

    // A local copy keeps the members of the grid in registers. Otherwise, the compiler would reload
    // them for each dot, which is slow on small processors.
    const Grid here = grid;
    const auto columns = static_cast<unsigned>(here.columns);
    const auto rows = static_cast<unsigned>(here.rows);
    std::uint16_t index = 0;
    for (const DetectedDot& dot : dots) {
        const GridPoint g = point_of(dot);
        const auto i = static_cast<unsigned>(g.cell.x - here.i0);
        const auto j = static_cast<unsigned>(g.cell.y - here.j0);
        // Projects the offset to get the two bits (paper, equations 7 and 8). Unlike in the paper,
        // y points down. The x bit is therefore 1 if the dot is displaced to the left or down, and
        // the y bit is 1 if the dot is displaced to the right or down.
        if (i < columns && j < rows) {
            const GridCell read{quasi_probability(g.offset_q16.y - g.offset_q16.x),
                                quasi_probability(g.offset_q16.y + g.offset_q16.x), index};
            GridCell& cell = here.storage[j * columns + i];
            // Keeps the better dot (paper, figure 8).
            if (quality(read) > quality(cell)) cell = read;
        }
        ++index;
    }
    return Status::ok;
}

}  // namespace

Status assign_likelihoods(std::span<const DetectedDot> dots, const PlaneFromImage& grid_from_image,
                          Grid& grid) {
    const auto exactly = [&](const DetectedDot& dot) {
        return grid_point(grid_from_image, dot.centre_q8);
    };
    return is_affine(grid_from_image) ? assign_affine_likelihoods(dots, grid_from_image, grid)
                                      : assign(dots, kWindowSide, exactly, grid);
}

Status assign_affine_likelihoods(std::span<const DetectedDot> dots,
                                 const PlaneFromImage& grid_from_image, Grid& grid, int min_side) {
    const Cells cells(grid_from_image);
    const auto quickly = [&](const DetectedDot& dot) {
        return cells(cells.from_centre_q3(dot.centre_q8));
    };
    return assign(dots, min_side, quickly, grid);
}

}  // namespace dotpose::core
