#include "core/pose/float_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::fit;

/// Returns the convergence threshold for `moved`, the squared length of the whitened step (see
/// `solve`). The threshold is larger for planes with little perspective and lens distortion,
/// because the fit of such planes is nearly linear, and a single step ends close to the solution.
float settled(const FloatPlane& p, float reach) {
    const float nonlinear =
        (std::abs(p.tilt_x) + std::abs(p.tilt_y)) * reach + std::abs(p.bend) * reach * reach;
    return std::clamp(tuned::kNonlinearSettled / (nonlinear * nonlinear + 1e-6F),
                      tuned::kMinSettled, tuned::kMaxSettled);
}

/// Returns true if the outlier limits `limit` and `next_limit` select practically the same inliers.
/// This is the case if all dots are inliers with both limits, or if the limits differ by less than
/// kSameLimit times `limit`.
bool keeps_dots(const FitSums& sums, float limit, float next_limit) {
    return (sums.outliers == 0 && sums.farthest <= next_limit) ||
           std::abs(next_limit - limit) < tuned::kSameLimit * limit;
}

}  // namespace

bool fit_plane(const Kernels& kernels, const MeasuredDots& dots, int reach_px, float limit,
               float displacement, FloatPlane& plane, PoseFit& fit) {
    constexpr float kExact = 6e-8F;
    const auto reach = static_cast<float>(reach_px);
    fit.reach_px = reach_px;
    for (int round = 0; round < tuned::kMaxRoundsOfFloats; ++round) {
        const ScaledPlane scaled(plane, reach);
        const FitSums sums = kernels.sum_fit(dots, plane, displacement, scaled.scale(), limit);
        if (sums.points < tuned::kMinDots) return false;
        fit.normal = PlaneNormal(sums);
        Parameters step;
        float moved = 0;
        if (!solve(scaled.distortions(), scaled.scale(), fit, step, moved)) return false;
        fit.displacement = sums.projected / static_cast<float>(sums.points);
        const float settled_before = settled(plane, reach);
        plane = scaled.changed(step);
        const bool is_settled = moved < std::min(settled_before, settled(plane, reach));
        const float next_limit = tuned::kOutlier * fit.variance + kExact;
        // The fit has converged: the step is small, and the inliers no longer change.
        if (is_settled && keeps_dots(sums, limit, next_limit)) return true;
        limit = next_limit;
    }
    return true;
}

}  // namespace dotpose::core
