#include "core/pose/float_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::fit;

/// Returns the step, in squared deviations of the pose, below which no other is needed. The less
/// the plane bends, the nearer a step ends to the solution.
float settled(const FloatPlane& p, float reach) {
    const float bent =
        (std::abs(p.tilt_x) + std::abs(p.tilt_y)) * reach + std::abs(p.bend) * reach * reach;
    return std::clamp(tuned::kBentSettled / (bent * bent + 1e-6F), tuned::kLeastSettled,
                      tuned::kMostSettled);
}

/// Returns whether the same dots count within another limit, or nearly so.
bool keeps_dots(const FitSums& sums, float limit, float other) {
    return (sums.outliers == 0 && sums.farthest <= other) ||
           std::abs(other - limit) < tuned::kSameLimit * limit;
}

}  // namespace

bool fit_plane(const Kernels& kernels, const MeasuredDots& dots, int reach_px, float limit,
               float displacement, FloatPlane& plane, PoseFit& fit) {
    constexpr float kExact = 6e-8F;
    const auto reach = static_cast<float>(reach_px);
    fit.reach_px = reach_px;
    for (int round = 0; round < tuned::kMostRoundsOfFloats; ++round) {
        const ScaledPlane scaled(plane, reach);
        const FitSums sums = kernels.sum_fit(dots, plane, displacement, scaled.scale(), limit);
        if (sums.points < tuned::kFewestDots) return false;
        fit.normal = PlaneNormalFloat(sums);
        Parameters step;
        float moved = 0;
        if (!solve(scaled.distortions(), scaled.scale(), fit, step, moved)) return false;
        fit.displacement = sums.projected / static_cast<float>(sums.points);
        const float bent_before = settled(plane, reach);
        plane = scaled.changed(step);
        const bool is_settled = moved < std::min(bent_before, settled(plane, reach));
        const float next_limit = tuned::kOutlier * fit.variance + kExact;
        // Rounds go on until a step settles the plane and the same dots count in the next round.
        if (is_settled && keeps_dots(sums, limit, next_limit)) return true;
        limit = next_limit;
    }
    return true;
}

}  // namespace dotpose::core
