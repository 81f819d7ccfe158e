#include "core/lattice/refine_grid.hpp"

#include <algorithm>
#include <array>

#include "core/fit/solve_plane.hpp"
#include "core/lattice/axes.hpp"
#include "core/lattice/regularity.hpp"
#include "core/lattice/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::refine_grid;

/// Maximum distance of a cell from cell (0, 0) along either axis, in cells. Dots in farther cells
/// are ignored.
constexpr int kFarthest_cells = 250;
constexpr std::size_t kMedianSample = tuned::kMedianSample;

/// Moves the origin by the median offset of the dots near the origin (paper, equation 6). The
/// offsets are measured from the estimated origin, so the median must be added to the origin. This
/// is the same as subtracting it from all plane points. The paper subtracts the median from the
/// origin, which is a sign error.
void centre_origin(std::span<const DetectedDot> dots, PlaneFromImage& plane) {
    std::array<std::int32_t, kMedianSample> x;
    std::array<std::int32_t, kMedianSample> y;
    std::size_t n = 0;
    for (const DetectedDot& dot : dots) {
        const GridPoint g = grid_point(plane, dot.centre_q8);
        if (larger_component(g.cell) > kFirstReach_cells || n == kMedianSample) continue;
        x[n] = g.offset_q16.x;
        y[n++] = g.offset_q16.y;
    }
    plane.at_centre_q16 = plane.at_centre_q16 -
                          FixedVec{median(std::span(x).first(n)), median(std::span(y).first(n))};
}

/// Agreement of the dots with the grid. All members except `farthest_cell` include only dots whose
/// cells are at most `reach_cells` from the origin.
struct Judged : Regularity {
    std::int64_t squared_offsets_q20 = 0;
};

Judged judge(std::span<const DetectedDot> dots, int reach_cells, const LatticeOptions& options,
             const PlaneFromImage& plane) {
    Judged found;
    for (const DetectedDot& dot : dots) {
        const GridPoint g = grid_point(plane, dot.centre_q8);
        const int distance = larger_component(g.cell);
        if (distance > kFarthest_cells) continue;
        found.farthest_cell = std::max(found.farthest_cell, distance);
        if (distance > reach_cells) continue;
        ++found.dots;
        found.squared_offsets_q20 += squared(g.offset_q16) >> 12;
        found.near_intersections += larger_component(g.offset_q16) <= options.max_offset_q16;
    }
    return found;
}

/// The point in the grid to which a dot is fitted.
struct Target {
    bool is_used = false;
    FixedVec place_q16;
};

/// Returns an upper bound on the distance of a dot from `centre_q8` along each axis, in whole px.
int reach_px(std::span<const DetectedDot> dots, FixedVec centre_q8) {
    std::int32_t reach = 1;
    for (const DetectedDot& dot : dots)
        reach = std::max(reach, larger_component(dot.centre_q8 - centre_q8) / 256 + 1);
    return reach;
}

/// Fits the plane to the targets of the dots with one Gauss-Newton step. `target_of(g)` returns the
/// target of a dot at grid point g. If the dots do not determine the step, the plane remains
/// unchanged.
template <typename TargetOf>
void fit_to_targets(std::span<const DetectedDot> dots, PlaneFromImage& plane, TargetOf target_of) {
    const int reach = reach_px(dots, plane.centre_q8);
    const ScaledPlane scaled = scaled_from_centre(plane, reach);
    PlaneSums sums;
    for (std::size_t i = 0; i < dots.size(); i += 4) {
        Four u{};
        Four v{};
        Residuals residuals{};
        for (std::size_t k = 0; k < std::min<std::size_t>(dots.size() - i, 4); ++k) {
            const FixedVec at_q8 = dots[i + k].centre_q8;
            const Target target = target_of(grid_point(plane, at_q8));
            if (!target.is_used) continue;
            const FixedVec from_centre_q8 = at_q8 - plane.centre_q8;
            const FixedVec offset_q16 = target.place_q16 - plane_point_q16(plane, at_q8);
            u[k] = static_cast<float>(from_centre_q8.x) / 256;
            v[k] = static_cast<float>(from_centre_q8.y) / 256;
            residuals.offset.x[k] = static_cast<float>(offset_q16.x) / 65536;
            residuals.offset.y[k] = static_cast<float>(offset_q16.y) / 65536;
            residuals.weight[k] = 1;
        }
        sums.add(scaled.project(u, v), residuals);
    }
    PoseFit fit;
    fit.reach_px = reach;
    fit.normal = PlaneNormal(sums.all());
    Parameters step;
    float moved = 0;
    if (solve(scaled.distortions(), scaled.scale(), fit, step, moved))
        plane = stepped(plane, scaled, step);
}

/// Fits the plane to the dots whose cells are at most `reach_cells` from the origin. Each dot is
/// fitted to its nearest intersection, or ignored if its offset exceeds `max_offset_q16` along an
/// axis. The paper computes the axis lengths as medians (text after equation 6). This fit instead
/// determines all terms by least squares. It treats displacements as noise.
void fit(std::span<const DetectedDot> dots, int reach_cells, const LatticeOptions& options,
         PlaneFromImage& plane) {
    fit_to_targets(dots, plane, [&](const GridPoint& g) {
        const bool is_near = larger_component(g.cell) <= reach_cells &&
                             larger_component(g.offset_q16) <= options.max_offset_q16;
        return Target{is_near, {g.cell.x * 65536, g.cell.y * 65536}};
    });
}

/// Fits the plane to displaced dots. Each dot is fitted to the nearest of the four dot positions of
/// its cell, or ignored if it is farther than kFar_q16 from this position.
void fit_places(std::span<const DetectedDot> dots, PlaneFromImage& plane) {
    constexpr std::int32_t kFar_q16 = tuned::kFar_q16;
    fit_to_targets(dots, plane, [](const GridPoint& g) {
        if (larger_component(g.cell) > kFarthest_cells) return Target{};
        const bool is_across = std::abs(g.offset_q16.x) > std::abs(g.offset_q16.y);
        const std::int32_t d = is_across ? g.offset_q16.x : g.offset_q16.y;
        const std::int32_t along = d > 0 ? kDisplacement_q16 : -kDisplacement_q16;
        const FixedVec place = is_across ? FixedVec{along, 0} : FixedVec{0, along};
        const bool is_near = squared(g.offset_q16 - place) <= std::int64_t{kFar_q16} * kFar_q16;
        return Target{is_near, FixedVec{g.cell.x * 65536, g.cell.y * 65536} + place};
    });
}

}  // namespace

Status refine_grid(std::span<const DetectedDot> dots, const LatticeOptions& options,
                   FixedVec image_centre_q8, const Lattice& first, PlaneFromImage& plane) {
    plane = plane_from_lattice(first, image_centre_q8);
    centre_origin(dots, plane);
    Judged found;
    const auto fit_and_judge = [&](int reach_cells) {
        fit(dots, reach_cells, options, plane);
        if (!is_nearly_square(plane)) return false;
        found = judge(dots, reach_cells, options, plane);
        return true;
    };
    if (!fit_outwards(tuned::kMaxRounds, found, fit_and_judge)) return Status::no_grid;
    fit(dots, found.farthest_cell, options, plane);
    found = judge(dots, found.farthest_cell, options, plane);
    const Status verdict = found.verdict(found.squared_offsets_q20 / std::max(found.dots, 1));
    for (int round = 0; verdict == Status::ok && round < tuned::kPlaceRounds; ++round)
        fit_places(dots, plane);
    return verdict;
}

}  // namespace dotpose::core
