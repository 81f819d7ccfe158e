#include "core/lattice/grow.hpp"

#include <cstdlib>

#include "core/cell_fit.hpp"
#include "core/cells.hpp"
#include "core/lattice/axes.hpp"

namespace dotpose::core {
namespace {

/// How far, in cells, the first estimate can be trusted: 3 % of error in the spacing, 1 degree in
/// the direction and 1/20 cell in the origin, added up, stay under the 1/3 cell that tells a
/// displaced dot from one of the next cell.
constexpr int kFirstReach_cells = 4;

std::int32_t larger(Vec a) {
    return std::max(std::abs(a.x), std::abs(a.y));
}

/// How well the dots within reach sit on the grid, and the grid that fits them best.
struct Regularity {
    int dots = 0;
    int near_intersections = 0;
    int farthest_cell = 0;  ///< of all dots, within reach or not
    std::int32_t squared_offsets_q14 = 0;
    CellFit fit;

    bool is_settled() const { return 20 * near_intersections >= 19 * dots; }
};

Regularity judge(std::span<const Dot> dots, int reach_cells, const LatticeOptions& options,
                 const PlaneFromImage& plane) {
    constexpr int kFarthest_cells = 500;
    const Cells cells(plane);
    Regularity found;
    for (const Dot& dot : dots) {
        const Vec p = cells.from_centre_q3(dot.centre_q8);
        const GridPoint g = cells(p);
        const int distance = larger(g.cell);
        if (distance > kFarthest_cells) continue;
        found.farthest_cell = std::max(found.farthest_cell, distance);
        if (distance > reach_cells) continue;
        ++found.dots;
        const Vec offset_q8{g.offset_q16.x >> 8, g.offset_q16.y >> 8};
        found.squared_offsets_q14 += (offset_q8.x * offset_q8.x + offset_q8.y * offset_q8.y) >> 2;
        if (larger(g.offset_q16) > options.max_offset_q16) continue;
        ++found.near_intersections;
        found.fit.add(p, g.cell);
    }
    return found;
}

}  // namespace

Status grow_grid(std::span<const Dot> dots, const LatticeOptions& options, Vec image_centre_q8,
                 const Lattice& first, PlaneFromImage& plane) {
    plane = plane_from_lattice(first, image_centre_q8);
    Regularity found;
    for (int reach = kFirstReach_cells;; reach += reach / 2 + 1) {
        // Dots that a better fit puts into other cells make the next one better still.
        constexpr int kMostRounds = 3;
        for (int round = 0; round < kMostRounds; ++round) {
            found = judge(dots, reach, options, plane);
            if (!found.fit.solve(0, plane) || !is_nearly_square(plane)) return Status::no_grid;
            if (found.is_settled()) break;
        }
        if (reach >= found.farthest_cell) break;
    }
    found = judge(dots, found.farthest_cell, options, plane);

    // Dots anywhere in their cells would be near an intersection in half of the cases, at a mean
    // square offset of 1/6; displaced ones always, at 1/36; those of a plain grid at 0.
    constexpr std::int32_t kScattered_q14 = (1 << 14) / 10;
    constexpr std::int32_t kUndisplaced_q14 = (1 << 14) / 256;
    const std::int32_t mean_q14 = found.squared_offsets_q14 / std::max(found.dots, 1);
    if (10 * found.near_intersections < 7 * found.dots || mean_q14 > kScattered_q14) {
        return Status::no_grid;
    }
    return mean_q14 < kUndisplaced_q14 ? Status::no_displacement : Status::ok;
}

}  // namespace dotpose::core
