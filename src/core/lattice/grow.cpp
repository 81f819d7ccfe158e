#include "core/lattice/grow.hpp"

#include "core/cell_fit.hpp"
#include "core/cells.hpp"
#include "core/lattice/axes.hpp"
#include "core/lattice/regularity.hpp"

namespace dotpose::core {
namespace {

/// How well the dots within reach sit on the grid, and the grid that fits them best.
struct Judged : Regularity {
    std::int32_t squared_offsets_q14 = 0;
    CellFit fit;
};

Judged judge(std::span<const Dot> dots, int reach_cells, const LatticeOptions& options,
             const PlaneFromImage& plane) {
    constexpr int kFarthest_cells = 500;
    const Cells cells(plane);
    Judged found;
    for (const Dot& dot : dots) {
        const Vec p = cells.from_centre_q3(dot.centre_q8);
        const GridPoint g = cells(p);
        const int distance = larger_component(g.cell);
        if (distance > kFarthest_cells) continue;
        found.farthest_cell = std::max(found.farthest_cell, distance);
        if (distance > reach_cells) continue;
        ++found.dots;
        const Vec offset_q8{g.offset_q16.x >> 8, g.offset_q16.y >> 8};
        found.squared_offsets_q14 += (offset_q8.x * offset_q8.x + offset_q8.y * offset_q8.y) >> 2;
        if (larger_component(g.offset_q16) > options.max_offset_q16) continue;
        ++found.near_intersections;
        found.fit.add(p, g.cell);
    }
    return found;
}

}  // namespace

Status grow_grid(std::span<const Dot> dots, const LatticeOptions& options, Vec image_centre_q8,
                 const Lattice& first, PlaneFromImage& plane) {
    plane = plane_from_lattice(first, image_centre_q8);
    Judged found;
    constexpr int kMostRounds = 3;
    const auto fit = [&](int reach_cells) {
        found = judge(dots, reach_cells, options, plane);
        return found.fit.solve(0, plane) && is_nearly_square(plane);
    };
    if (!fit_outwards(kMostRounds, found, fit)) return Status::no_grid;
    found = judge(dots, found.farthest_cell, options, plane);
    const std::int32_t mean_q14 = found.squared_offsets_q14 / std::max(found.dots, 1);
    return found.verdict(mean_q14 * 64);
}

}  // namespace dotpose::core
