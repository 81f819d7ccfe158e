#include "core/pose/float_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/pose/group_scatter.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::fit;

/// Returns perspective, shear and lens of a plane in units of the reach; see ScaledPlane.
Parameters distortions(const FloatPlane& p, float reach) {
    return {0,
            0,
            0,
            0,
            p.tilt_x * reach,
            p.tilt_y * reach,
            (p.du_x - p.dv_y) * reach / 2,
            (p.dv_x + p.du_y) * reach / 2,
            p.bend * reach * reach};
}

float scale_of(const FloatPlane& p, float reach) {
    return reach *
           std::sqrt((p.du_x * p.du_x + p.du_y * p.du_y + p.dv_x * p.dv_x + p.dv_y * p.dv_y) / 2);
}

FloatPlane changed(const FloatPlane& p, const Parameters& by, float reach) {
    const float unit = 1 / reach;
    return {p.at_x + by[0],
            p.at_y + by[1],
            p.du_x + (by[2] + by[6]) * unit,
            p.du_y + (by[3] + by[7]) * unit,
            p.dv_x + (by[7] - by[3]) * unit,
            p.dv_y + (by[2] - by[6]) * unit,
            p.tilt_x + by[4] * unit,
            p.tilt_y + by[5] * unit,
            p.bend + by[8] * unit * unit};
}

/// Returns the step, in squared deviations of the pose, below which no other is needed. The less
/// the plane bends, the nearer a step ends to the solution.
float settled(const FloatPlane& p, float reach) {
    const float bent =
        (std::abs(p.tilt_x) + std::abs(p.tilt_y)) * reach + std::abs(p.bend) * reach * reach;
    return std::clamp(tuned::kBentSettled / (bent * bent + 1e-6F), tuned::kLeastSettled,
                      tuned::kMostSettled);
}

/// Returns whether neighbouring dots are off independently of each other, as on flat paper. If not,
/// blocks of dots tell more (pose/uneven).
bool is_plainly_even(const FittingDots& fitting) {
    if (fitting.outliers > 3 + fitting.points / 50) return false;
    const GroupScatter runs{fitting.squares, fitting.squares_of_runs,
                            static_cast<float>(fitting.points), static_cast<float>(fitting.runs)};
    return runs.excess() <= tuning::uneven::kSuspectRuns;
}

}  // namespace

bool fit_plane(const Kernels& kernels, const MeasuredDots& dots, int reach_px, float limit,
               float displacement, FloatPlane& plane, PoseFit& fit) {
    constexpr float kExact = 6e-8F;
    const auto reach = static_cast<float>(reach_px);
    fit.reach_px = reach_px;
    fit.is_plainly_even = false;
    for (int round = 0; round < tuned::kMostRoundsOfFloats; ++round) {
        const FitSums sums = kernels.sum_fit(dots, plane, displacement, reach, limit);
        if (sums.points < tuned::kFewestDots) return false;
        fit.normal = PlaneNormalFloat(sums);
        Parameters step;
        float moved = 0;
        if (!solve(distortions(plane, reach), scale_of(plane, reach), fit, step, moved))
            return false;
        fit.displacement = sums.projected / sums.points;
        const float bent_before = settled(plane, reach);
        plane = changed(plane, step, reach);
        const float next_limit = tuned::kOutlier * fit.variance + kExact;
        const bool is_settled = moved < std::min(bent_before, settled(plane, reach));
        limit = next_limit;
        // Rounds go on until a step settles the plane and the same dots count in the next round.
        if (!is_settled) continue;
        const FittingDots fitting = kernels.count_fitting(dots, plane, displacement, limit);
        fit.is_plainly_even = is_plainly_even(fitting);
        if (fitting.points == fit.normal.points()) return true;
    }
    return true;
}

}  // namespace dotpose::core
