#include "core/pose/covariance.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::core {
namespace {

/// Returns the gradient of an angle, in rad, with respect to the parameters. The angle is the
/// direction from point `from` to point `to` in `places`. `scale` is the unit of `places`, in
/// spacings.
Parameters direction_gradient(const FourVecs& places, float scale, std::size_t from,
                              std::size_t to) {
    const float x = (places.x[to] - places.x[from]) * scale;
    const float y = (places.y[to] - places.y[from]) * scale;
    const auto of_from = jacobian(places, from);
    const auto of_to = jacobian(places, to);
    const float over = 1 / (x * x + y * y);
    Parameters gradient;
    for (std::size_t i = 0; i < gradient.size(); ++i) {
        gradient[i] =
            (x * (of_to[1][i] - of_from[1][i]) - y * (of_to[0][i] - of_from[0][i])) * over;
    }
    return gradient;
}

/// Multiplies the covariance of the whitened parameters by a vector. Only adjacent parameters are
/// correlated, so the covariance is tridiagonal, and all other elements are skipped.
Parameters times(const std::array<Parameters, kPoseParameters>& covariance, const Parameters& a) {
    Parameters product;
    for (std::size_t k = 0; k < kPoseParameters; ++k) {
        product[k] = covariance[k][k] * a[k];
        if (k > 0) product[k] += covariance[k][k - 1] * a[k - 1];
        if (k + 1 < kPoseParameters) product[k] += covariance[k][k + 1] * a[k + 1];
    }
    return product;
}

float inner_product(const Parameters& a, const Parameters& b) {
    float sum = 0;
    for (std::size_t k = 0; k < kPoseParameters; ++k)
        sum += a[k] * b[k];
    return sum;
}

}  // namespace

void estimate_covariance(const PoseFit& fit, const PlaneFromImage& pattern_from_image,
                         FixedVec reference_q8, Fix& fix) {
    fix.dots_used = fit.dots;
    fix.surface = fit.surface;
    // Increases `dots_seen` to at least `dots_used`. More dots may be used than were detected as
    // blobs, because every predicted dot is measured.
    fix.dots_seen = std::max(fix.dots_seen, fix.dots_used);
    fix.residual_px = std::sqrt(fit.variance) * static_cast<float>(fix.spacing_px_q16) / 65536.0F;
    const ScaledPlane plane(float_plane(pattern_from_image), static_cast<float>(fit.reach_px));
    // Theta is the direction of the image's x axis in the pattern. It is approximated by the
    // direction between the points kStep_px to the left and right of the reference point.
    constexpr float kStep_px = 8;
    const FixedVec from_centre_q8 = reference_q8 - pattern_from_image.centre_q8;
    const float x = static_cast<float>(from_centre_q8.x) / 256;
    const float y = static_cast<float>(from_centre_q8.y) / 256;
    const FourVecs places = plane.project(Four{x, x - kStep_px, x + kStep_px}, Four{y, y, y});
    const auto here = jacobian(places, 0);
    std::array<Parameters, 3> gradients{here[0], here[1],
                                        direction_gradient(places, plane.scale(), 1, 2)};
    for (Parameters& gradient : gradients)
        gradient = fit.normal.whitened(gradient);
    for (std::size_t j = 0; j < 3; ++j) {
        const Parameters product = times(fit.covariance, gradients[j]);
        for (std::size_t i = j; i < 3; ++i)
            fix.covariance[i][j] = fix.covariance[j][i] =
                inner_product(gradients[i], product) + fit.uneven[i][j];
    }
}

}  // namespace dotpose::core
