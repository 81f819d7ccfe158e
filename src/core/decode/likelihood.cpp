#include "core/decode/likelihood.hpp"

#include "core/math/cells.hpp"

namespace dotpose::core {
namespace {

struct Extent {
    int first = 0;
    int count = 0;
};

/// Returns the cells from `least` to `most`, or as many as there is room for around the origin.
Extent extent(int least, int most, int capacity) {
    if (most - least < capacity) return {least, most - least + 1};
    const int first = std::clamp(-capacity / 2, least, most - capacity + 1);
    return {first, capacity};
}

}  // namespace

void lay_out(Vec least, Vec most, Grid& grid) {
    const Extent columns = extent(least.x, most.x, grid.side);
    const Extent rows = extent(least.y, most.y, grid.side);
    grid.i0 = columns.first;
    grid.columns = columns.count;
    grid.j0 = rows.first;
    grid.rows = rows.count;
    std::fill_n(grid.storage.begin(), grid.columns * grid.rows, GridCell{});
}

std::int8_t quasi_probability(std::int32_t projection_q16) {
    // The nominal offset r0 is the displacement, a sixth of the spacing.
    const int r_q8 = (projection_q16 * 6 + 128) >> 8;  // r / r0
    const int square_q16 = r_q8 * r_q8;
    if (square_q16 >= 3 * 65536) return 0;
    // Eq. 9: (3 r - r^3) / 2 in units of r0
    const int f_q8 = (r_q8 * (3 * 65536 - square_q16)) >> 17;
    return static_cast<std::int8_t>((f_q8 * 127 + 128) >> 8);
}

namespace {

/// Fills the grid from all dots. `point_of(dot)` returns the place of a dot in the grid.
template <typename PointOf>
Status assign(std::span<const Dot> dots, PointOf point_of, Grid& grid) {
    Vec least{INT32_MAX, INT32_MAX};
    Vec most{INT32_MIN, INT32_MIN};
    for (const Dot& dot : dots) {
        const Vec cell = point_of(dot).cell;
        least = {std::min(least.x, cell.x), std::min(least.y, cell.y)};
        most = {std::max(most.x, cell.x), std::max(most.y, cell.y)};
    }
    if (dots.empty() || most.x - least.x + 1 < kWindowSide || most.y - least.y + 1 < kWindowSide) {
        return Status::grid_too_small;
    }
    lay_out(least, most, grid);

    // With a local copy, small processors need not read the grid's members anew for each dot.
    const Grid here = grid;
    const auto columns = static_cast<unsigned>(here.columns);
    const auto rows = static_cast<unsigned>(here.rows);
    std::uint16_t index = 0;
    for (const Dot& dot : dots) {
        const GridPoint g = point_of(dot);
        const auto i = static_cast<unsigned>(g.cell.x - here.i0);
        const auto j = static_cast<unsigned>(g.cell.y - here.j0);
        // Eq. 7-8. differs: with y down, left and down mean x bit 1, right and down y bit 1.
        if (i < columns && j < rows) {
            const GridCell read{quasi_probability(g.offset_q16.y - g.offset_q16.x),
                                quasi_probability(g.offset_q16.y + g.offset_q16.x), index};
            GridCell& cell = here.storage[j * columns + i];
            if (quality(read) > quality(cell)) cell = read;  // Fig. 8
        }
        ++index;
    }
    return Status::ok;
}

}  // namespace

Status assign_likelihoods(std::span<const Dot> dots, const PlaneFromImage& grid_from_image,
                          Grid& grid) {
    const auto exactly = [&](const Dot& dot) { return grid_point(grid_from_image, dot.centre_q8); };
    return is_affine(grid_from_image) ? assign_affine_likelihoods(dots, grid_from_image, grid)
                                      : assign(dots, exactly, grid);
}

Status assign_affine_likelihoods(std::span<const Dot> dots, const PlaneFromImage& grid_from_image,
                                 Grid& grid) {
    const Cells cells(grid_from_image);
    const auto quickly = [&](const Dot& dot) { return cells(cells.from_centre_q3(dot.centre_q8)); };
    return assign(dots, quickly, grid);
}

}  // namespace dotpose::core
