#include "core/lattice/refine_grid.hpp"

#include <array>

#include "core/fit/plane_fit_int64.hpp"
#include "core/lattice/axes.hpp"
#include "core/lattice/regularity.hpp"
#include "core/lattice/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::refine_grid;

/// Maximum distance of a cell that is used, in cells. PlaneFitInt64 states the limit.
constexpr int kFarthest_cells = 250;
constexpr std::size_t kMedianSample = tuned::kMedianSample;

/// Corrects the origin by eq. 6: the error of the origin is the median offset of the dots near it.
/// The offset is relative to the estimate, so the difference o - median of the paper becomes a sum.
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

/// Agreement of the dots within reach with the grid.
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

/// Place in the grid to which a dot is assigned, in spacings.
struct Target {
    bool is_used = false;
    std::int16_t cell_x = 0;
    std::int16_t cell_y = 0;
    std::int16_t x_q16 = 0;  ///< relative to the intersection
    std::int16_t y_q16 = 0;

    Target() = default;
    Target(FixedVec cell, FixedVec from_intersection_q16)
        : is_used(true),
          cell_x(static_cast<std::int16_t>(cell.x)),
          cell_y(static_cast<std::int16_t>(cell.y)),
          x_q16(static_cast<std::int16_t>(from_intersection_q16.x)),
          y_q16(static_cast<std::int16_t>(from_intersection_q16.y)) {}
    FixedVec place_q16() const { return {cell_x * 65536 + x_q16, cell_y * 65536 + y_q16}; }
};

/// Fits the plane to dots and their targets. `target_of(g)` returns the target of a dot whose
/// GridPoint is g.
template <typename TargetOf>
void fit_to_targets(std::span<const DetectedDot> dots, Terms max_terms, PlaneFromImage& plane,
                    TargetOf target_of) {
    // The fit visits the dots several times. For the dots of most images, the targets are computed
    // once. In larger images, the targets of further dots are computed again.
    std::array<Target, 2048> targets;
    const std::size_t known = std::min(dots.size(), targets.size());
    const PlaneFromImage before = plane;
    const auto target = [&](const DetectedDot& dot) {
        return target_of(grid_point(before, dot.centre_q8));
    };
    for (std::size_t i = 0; i < known; ++i)
        targets[i] = target(dots[i]);
    const auto visit = [&](auto use) {
        for (std::size_t i = 0; i < dots.size(); ++i) {
            const Target own = i < known ? targets[i] : target(dots[i]);
            if (own.is_used) use(dots[i].centre_q8, own.place_q16());
        }
    };
    FittedPlane fitted;
    if (fit_significant_plane(before, max_terms, visit, fitted)) plane = fitted.plane;
}

/// Fits the plane to the dots within reach. differs: eq. 6 continues with median lengths between
/// neighbours. Here a least-squares fit, in which displacements are noise, determines all terms,
/// and the reach grows from round to round.
void fit(std::span<const DetectedDot> dots, int reach_cells, const LatticeOptions& options,
         PlaneFromImage& plane) {
    const Terms max_terms =
        reach_cells < tuned::kLensReach_cells ? Terms::perspective : Terms::lens;
    fit_to_targets(dots, max_terms, plane, [&](const GridPoint& g) {
        const bool is_near = larger_component(g.cell) <= reach_cells &&
                             larger_component(g.offset_q16) <= options.max_offset_q16;
        return is_near ? Target(g.cell, {}) : Target();
    });
}

/// Fits the plane to the places of displaced dots. Each dot is assigned to the nearest of the four
/// places of its cell. Leaves out dots that are far from all four places.
void fit_places(std::span<const DetectedDot> dots, PlaneFromImage& plane) {
    constexpr std::int32_t kFar_q16 = tuned::kFar_q16;
    fit_to_targets(dots, Terms::lens, plane, [](const GridPoint& g) {
        if (larger_component(g.cell) > kFarthest_cells) return Target();
        const bool is_across = std::abs(g.offset_q16.x) > std::abs(g.offset_q16.y);
        const std::int32_t d = is_across ? g.offset_q16.x : g.offset_q16.y;
        const std::int32_t along = d > 0 ? kDisplacement_q16 : -kDisplacement_q16;
        const FixedVec place = is_across ? FixedVec{along, 0} : FixedVec{0, along};
        const bool is_near = squared(g.offset_q16 - place) <= std::int64_t{kFar_q16} * kFar_q16;
        return is_near ? Target(g.cell, place) : Target();
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
