#include "core/pose/covariance.hpp"

#include <cmath>

namespace dotpose::core {
namespace {

/// Derivatives, by the parameters, of the direction in which a step in the image leads.
Parameters direction_gradient(const ScaledPlane& plane, Vec reference_q8, Vec step_q8) {
    const ScaledPlane::Sight from = plane.look(reference_q8 - step_q8);
    const ScaledPlane::Sight to = plane.look(reference_q8 + step_q8);
    const float x = to.x - from.x;
    const float y = to.y - from.y;
    Parameters gradient;
    for (std::size_t i = 0; i < gradient.size(); ++i) {
        gradient[i] = (x * (to.jacobian[1][i] - from.jacobian[1][i]) -
                       y * (to.jacobian[0][i] - from.jacobian[0][i])) /
                      (x * x + y * y);
    }
    return gradient;
}

}  // namespace

void estimate_covariance(const PoseFit& fit, const PlaneFromImage& pattern_from_image,
                         Vec reference_q8, Fix& fix) {
    fix.dots_used = fit.dots;
    fix.residual_px = std::sqrt(fit.variance) * static_cast<float>(fix.spacing_px_q16) / 65536.0F;
    const ScaledPlane plane(pattern_from_image, fit.reach_px);
    const auto here = plane.look(reference_q8).jacobian;
    // Theta is the direction of the image x axis.
    constexpr std::int32_t kStep_q8 = 8 * 256;
    std::array<Parameters, 3> gradients{here[0], here[1],
                                        direction_gradient(plane, reference_q8, {kStep_q8, 0})};
    for (Parameters& gradient : gradients)
        gradient = fit.normal.whitened(gradient);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            float sum = 0;
            for (std::size_t k = 0; k < kPoseParameters; ++k) {
                for (std::size_t l = 0; l < kPoseParameters; ++l)
                    sum += gradients[i][k] * fit.covariance[k][l] * gradients[j][l];
            }
            fix.covariance[i][j] = fix.covariance[j][i] = sum;
        }
    }
}

}  // namespace dotpose::core
