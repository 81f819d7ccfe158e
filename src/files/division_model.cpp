#include "files/division_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "files/least_squares.hpp"

namespace dotpose::files {
namespace {

/// Maximum undistorted coordinate. A larger coordinate shows that the iteration did not converge.
constexpr double kMaxUndistorted_px = 1e6;

/// Number of parameters: k, the two coordinates of the centre, and the six parameters of an affine
/// map. The affine map is included because every pose fit contains such a map. Lengths are in units
/// of half the image diagonal.
constexpr std::size_t kParameters = 9;
using Fit = LeastSquares<kParameters>;
using Parameters = Fit::Vector;

/// Distorted and undistorted position of one image point, in the same units.
struct Pair {
    PixelPoint seen;
    PixelPoint wanted;
};

/// Residual of a pair, and its derivatives. The distorted point is undistorted (equation 2 of the
/// paper) and transformed by the affine map. The residual is the result minus the undistorted point
/// of the pair.
struct Misfit {
    double u = 0;
    double v = 0;
    Parameters du{};  ///< derivatives with respect to the parameters
    Parameters dv{};

    Misfit(const Pair& pair, const Parameters& p) {
        const double a = pair.seen.u - p[1];
        const double b = pair.seen.v - p[2];
        const double r2 = a * a + b * b;
        const double shrink = 1 / (1 + p[0] * r2);
        const double x = shrink * a;
        const double y = shrink * b;
        u = p[3] + p[4] * x + p[5] * y - pair.wanted.u;
        v = p[6] + p[7] * x + p[8] * y - pair.wanted.v;
        // Derivatives of x and y with respect to k and to the coordinates of the centre.
        const double by_k = -shrink * r2;
        const double bend = 2 * p[0] * shrink;
        const std::array dx = {by_k * x, bend * x * a - shrink, bend * x * b};
        const std::array dy = {by_k * y, bend * y * a, bend * y * b - shrink};
        for (std::size_t i = 0; i < 3; ++i) {
            du[i] = p[4] * dx[i] + p[5] * dy[i];
            dv[i] = p[7] * dx[i] + p[8] * dy[i];
        }
        du[3] = dv[6] = 1;
        du[4] = dv[7] = x;
        du[5] = dv[8] = y;
    }
};

double squares_of(const std::vector<Pair>& pairs, const Parameters& parameters) {
    double squares = 0;
    for (const Pair& pair : pairs) {
        const Misfit misfit(pair, parameters);
        squares += misfit.u * misfit.u + misfit.v * misfit.v;
    }
    return squares;
}

/// Returns a Levenberg-Marquardt step.
Parameters step_of(const std::vector<Pair>& pairs, const Parameters& parameters, double damping) {
    Fit fit;
    Parameters norms2{};
    for (const Pair& pair : pairs) {
        const Misfit misfit(pair, parameters);
        fit.add(misfit.du, -misfit.u);
        fit.add(misfit.dv, -misfit.v);
        for (std::size_t i = 0; i < kParameters; ++i)
            norms2[i] += misfit.du[i] * misfit.du[i] + misfit.dv[i] * misfit.dv[i];
    }
    for (std::size_t i = 0; i < kParameters; ++i) {
        Parameters row{};
        row[i] = std::sqrt(damping * norms2[i]);
        fit.add(row, 0);
    }
    return fit.solve();
}

/// Minimises the sum of squared residuals. Stops when the steps are smaller than rounding errors.
/// Returns the minimum.
double minimise(const std::vector<Pair>& pairs, Parameters& parameters) {
    constexpr int kMaxSteps = 500;
    constexpr double kMaxDamping = 1e9;
    constexpr double kMinStep = 1e-12;
    double damping = 1e-4;
    double squares = squares_of(pairs, parameters);
    for (int i = 0; i < kMaxSteps && damping < kMaxDamping; ++i) {
        const Parameters step = step_of(pairs, parameters, damping);
        Parameters next = parameters;
        double longest = 0;
        for (std::size_t j = 0; j < kParameters; ++j) {
            next[j] += step[j];
            longest = std::max(longest, std::abs(step[j]));
        }
        const double next_squares = squares_of(pairs, next);
        if (next_squares < squares) {
            parameters = next;
            squares = next_squares;
            damping /= 5;
        } else {
            damping *= 1.5;
        }
        if (longest < kMinStep) break;
    }
    return squares;
}

}  // namespace

PixelPoint PlumbBob::undistorted(PixelPoint pixel) const {
    const double xd = (pixel.u - cx) / fx;
    const double yd = (pixel.v - cy) / fy;
    double x = xd;
    double y = yd;
    // Number of fixed-point iterations. There is no closed-form solution.
    constexpr int kIterations = 100;
    for (int i = 0; i < kIterations; ++i) {
        const double r2 = x * x + y * y;
        const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
        const double tangential_x = 2 * t1 * x * y + t2 * (r2 + 2 * x * x);
        const double tangential_y = t1 * (r2 + 2 * y * y) + 2 * t2 * x * y;
        x = (xd - tangential_x) / radial;
        y = (yd - tangential_y) / radial;
    }
    return {cx + fx * x, cy + fy * y};
}

double fit_division_model(const PlumbBob& lens, Camera& camera) {
    camera.k_per_px2 = 0;
    camera.centre_px = {lens.cx, lens.cy};
    camera.pinhole = Pinhole{lens.fx, lens.fy, camera.centre_px};
    // No fit is needed for a lens without distortion. Its distortion centre is arbitrary.
    if (lens.is_straight()) return 0;
    constexpr int kSteps = 16;
    const double reach_px = std::hypot(camera.width_px, camera.height_px) / 2;
    std::vector<Pair> pairs;
    for (int j = 0; j <= kSteps; ++j) {
        for (int i = 0; i <= kSteps; ++i) {
            const PixelPoint pixel{(camera.width_px - 1.0) * i / kSteps,
                                   (camera.height_px - 1.0) * j / kSteps};
            const PixelPoint wanted = lens.undistorted(pixel);
            if (!(std::abs(wanted.u) <= kMaxUndistorted_px &&
                  std::abs(wanted.v) <= kMaxUndistorted_px)) {
                return std::numeric_limits<double>::infinity();
            }
            pairs.push_back({{pixel.u / reach_px, pixel.v / reach_px},
                             {wanted.u / reach_px, wanted.v / reach_px}});
        }
    }
    const double u = lens.cx / reach_px;
    const double v = lens.cy / reach_px;
    Parameters parameters = {0, u, v, u, 1, 0, v, 0, 1};
    const double squares = minimise(pairs, parameters);
    camera.k_per_px2 = parameters[0] / (reach_px * reach_px);
    camera.centre_px = {parameters[1] * reach_px, parameters[2] * reach_px};
    // The affine map changes the scale of the undistorted image and moves the optical axis. Its
    // shear is negligible.
    const auto& p = parameters;
    camera.pinhole = Pinhole{lens.fx / p[4],
                             lens.fy / p[8],
                             {(lens.cx - reach_px * (p[3] - p[4] * p[1])) / p[4],
                              (lens.cy - reach_px * (p[6] - p[8] * p[2])) / p[8]}};
    return std::sqrt(squares / static_cast<double>(pairs.size())) * reach_px;
}

}  // namespace dotpose::files
