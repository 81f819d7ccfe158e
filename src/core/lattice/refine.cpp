#include "core/lattice/refine.hpp"

#include <array>

#include "core/lattice/axes.hpp"
#include "core/plane_fit.hpp"

namespace dotpose::core {
namespace {

/// How far, in cells, the first estimate can be trusted: 3 % of error in the spacing, 1 degree in
/// the direction and 1/20 cell in the origin, added up, stay under the 1/3 cell that tells a
/// displaced dot from one of the next cell.
constexpr int kFirstReach_cells = 4;
/// Reach from which dots can tell the curvature of a lens from their displacements.
constexpr int kLensReach_cells = 9;
/// Cells beyond are not used: see PlaneFit.
constexpr int kFarthest_cells = 250;
constexpr std::size_t kMedianSample = 256;

std::int32_t larger(Vec a) {
    return std::max(std::max(a.x, -a.x), std::max(a.y, -a.y));
}

/// Eq. 6: the median offset of the dots near the origin is the error of the origin. It is measured
/// from the estimate, so the paper's o - median becomes a plus.
void centre_origin(std::span<const Dot> dots, PlaneFromImage& plane) {
    std::array<std::int32_t, kMedianSample> x;
    std::array<std::int32_t, kMedianSample> y;
    std::size_t n = 0;
    for (const Dot& dot : dots) {
        const GridPoint g = grid_point(plane, dot.centre_q8);
        if (larger(g.cell) > kFirstReach_cells || n == kMedianSample) continue;
        x[n] = g.offset_q16.x;
        y[n++] = g.offset_q16.y;
    }
    plane.at_centre_q16 =
        plane.at_centre_q16 - Vec{median(std::span(x).first(n)), median(std::span(y).first(n))};
}

/// How well the dots within reach sit on the grid.
struct Regularity {
    int dots = 0;
    int near_intersections = 0;
    int farthest_cell = 0;  ///< of all dots, within reach or not
    std::int64_t squared_offsets_q20 = 0;
};

Regularity judge(std::span<const Dot> dots, int reach_cells, const LatticeOptions& options,
                 const PlaneFromImage& plane) {
    Regularity regularity;
    for (const Dot& dot : dots) {
        const GridPoint g = grid_point(plane, dot.centre_q8);
        const int distance = larger(g.cell);
        if (distance > kFarthest_cells) continue;
        regularity.farthest_cell = std::max(regularity.farthest_cell, distance);
        if (distance > reach_cells) continue;
        ++regularity.dots;
        regularity.squared_offsets_q20 += squared(g.offset_q16) >> 12;
        regularity.near_intersections += larger(g.offset_q16) <= options.max_offset_q16;
    }
    return regularity;
}

/// differs: eq. 6 continues with median lengths between neighbours; a least-squares fit to the dots
/// within reach, displacements taken as noise, gives all terms at once, and reaches on from there.
void fit(std::span<const Dot> dots, int reach_cells, const LatticeOptions& options,
         PlaneFromImage& plane) {
    const auto visit = [&](auto use) {
        for (const Dot& dot : dots) {
            const GridPoint g = grid_point(plane, dot.centre_q8);
            if (larger(g.cell) > reach_cells || larger(g.offset_q16) > options.max_offset_q16)
                continue;
            use(dot.centre_q8, Vec{g.cell.x * 65536, g.cell.y * 65536});
        }
    };
    const Terms most = reach_cells < kLensReach_cells ? Terms::perspective : Terms::lens;
    FittedPlane fitted;
    if (fit_plane(plane, most, visit, fitted)) plane = fitted.plane;
}

}  // namespace

Status refine_grid(std::span<const Dot> dots, const LatticeOptions& options, Vec image_centre_q8,
                   const Lattice& first, PlaneFromImage& plane) {
    plane = plane_from_lattice(first, image_centre_q8);
    centre_origin(dots, plane);
    Regularity regularity;
    for (int reach = kFirstReach_cells;; reach += reach / 2 + 1) {
        // Dots that a better fit puts into other cells make the next one better still.
        constexpr int kMostRounds = 4;
        for (int round = 0; round < kMostRounds; ++round) {
            fit(dots, reach, options, plane);
            if (!is_nearly_square(plane)) return Status::no_grid;
            regularity = judge(dots, reach, options, plane);
            if (20 * regularity.near_intersections >= 19 * regularity.dots) break;
        }
        if (reach >= regularity.farthest_cell) break;
    }
    fit(dots, regularity.farthest_cell, options, plane);
    regularity = judge(dots, regularity.farthest_cell, options, plane);

    // Dots anywhere in their cells would be near an intersection in half of the cases, at a mean
    // square offset of 1/6; displaced ones always, at 1/36; those of a plain grid at 0.
    constexpr std::int64_t kScattered_q20 = (1 << 20) / 10;
    constexpr std::int64_t kUndisplaced_q20 = (1 << 20) / 256;
    const std::int64_t mean_q20 = regularity.squared_offsets_q20 / std::max(regularity.dots, 1);
    if (10 * regularity.near_intersections < 7 * regularity.dots || mean_q20 > kScattered_q20) {
        return Status::no_grid;
    }
    return mean_q20 < kUndisplaced_q20 ? Status::no_displacement : Status::ok;
}

}  // namespace dotpose::core
