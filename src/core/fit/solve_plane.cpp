#include "core/fit/solve_plane.hpp"

#include <algorithm>
#include <cmath>

#include "core/fit/posterior.hpp"

namespace dotpose::core {
namespace {

/// Priors for perspective, shear and lens distortion. Standard deviations are in units of
/// ScaledPlane::scale(). A perspective term is the relative change in scale from the centre to the
/// outermost dot, for example 0.01 at a tilt of 2 degrees. The lens term is the displacement of the
/// outermost dot relative to its distance from the centre. The prior probability of lens distortion
/// is only 1 %, so an insignificant distortion is shrunk almost to 0.
constexpr std::array<DistortionPrior, 3> kTerms{{
    {kTilt, 2, {{{0.1F, 0}, {0.8F, 0.01F}, {0.1F, 0.1F}}}},
    {kShear, 2, {{{0.5F, 0}, {0.4F, 0.002F}, {0.1F, 0.03F}}}},
    {kBend, 1, {{{0.99F, 0}, {0.005F, 0.01F}, {0.005F, 0.1F}}}},
}};

/// Removes the contribution of a large shear from the whitened perspective terms. Without this, the
/// prior would treat the shear as perspective, because the dots are not symmetric about the centre.
/// Motion during the readout of a rolling shutter causes such a shear, as does a large tilt.
/// `distortions` contains the terms before the step.
void separate_shear(const PlaneNormal& normal, const Parameters& distortions, float unit,
                    Parameters& whitened) {
    constexpr float kLargeShear = 0.01F;  // in units of ScaledPlane::scale(), like the priors
    const float shear = std::abs(distortions[kShear]) + std::abs(distortions[kShear + 1]);
    if (shear < kLargeShear * unit) return;
    const Parameters terms = normal.unwhitened(whitened);
    for (std::size_t tilt = kTilt; tilt < kTilt + 2; ++tilt) {
        for (std::size_t i = kShear; i < kShear + 2; ++i)
            whitened[tilt] -= normal.factor(i, tilt) * terms[i];
    }
}

/// Adjusts a whitened step so that the distortion terms of the plane become their posterior means.
/// `whole` contains the whitened distortion terms after the original step, without the contribution
/// of a large shear to the perspective terms. Sets the covariance of
/// `fit`.
void shrink(const Parameters& whole, float unit, PoseFit& fit, Parameters& step) {
    fit.covariance = {};
    for (std::size_t i = 0; i < kTilt; ++i)
        fit.covariance[i][i] = fit.variance;
    for (const DistortionPrior& terms : kTerms) {
        const Posterior posterior = posterior_of(terms, fit.normal, whole, fit.variance, unit);
        for (std::size_t i = 0; i < terms.count; ++i) {
            step[terms.first + i] += posterior.mean[i] - whole[terms.first + i];
            for (std::size_t j = 0; j < terms.count; ++j)
                fit.covariance[terms.first + i][terms.first + j] = posterior.covariance[i][j];
        }
    }
}

}  // namespace

ScaledPlane scaled_from_centre(const PlaneFromImage& plane, int reach_px) {
    PlaneFromImage from_centre = plane;
    from_centre.at_centre_q16 = {};
    return {float_plane(from_centre), static_cast<float>(reach_px)};
}

PlaneFromImage stepped(const PlaneFromImage& plane, const ScaledPlane& scaled,
                       const Parameters& step) {
    PlaneFromImage next = fixed_plane(scaled.changed(step), plane.centre_q8);
    next.at_centre_q16 = next.at_centre_q16 + plane.at_centre_q16;
    return next;
}

bool solve(const Parameters& distortions, float unit, PoseFit& fit, Parameters& step,
           float& moved) {
    PlaneNormal& normal = fit.normal;
    if (normal.points() < 3 || !normal.decompose()) return false;
    step = normal.whitened(normal.right());
    float residual_squares = normal.squared_residuals();
    for (const float part : step)
        residual_squares -= part * part;
    fit.dots = normal.points();
    const int freedom = std::max(2 * fit.dots - static_cast<int>(kPoseParameters), 1);
    constexpr float kExact = 1e-12F;
    fit.variance = std::max(residual_squares / static_cast<float>(freedom), kExact);
    // Adds the step to the current distortion terms. Both vectors are whitened, so the errors of
    // all elements are independent and have the variance `fit.variance`.
    Parameters whole = normal.times_transposed(distortions);
    for (std::size_t i = 0; i < kPoseParameters; ++i)
        whole[i] += step[i];
    separate_shear(normal, distortions, unit, whole);
    const Parameters exact = step;
    shrink(whole, unit, fit, step);
    moved = 0;
    fit.squares = residual_squares;
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        const float lost = exact[i] - step[i];
        moved += step[i] * step[i];
        fit.squares += lost * lost;
    }
    moved /= fit.variance;
    step = normal.unwhitened(step);
    return true;
}

}  // namespace dotpose::core
