#include "calibrate/paper_view.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include <ceres/ceres.h>

#include "calibrate/least_squares.hpp"
#include "calibrate/normal_inverse.hpp"

namespace dotpose::calibrate {
namespace {

/// Maximum relative standard deviation of a reported focal length.
constexpr double kMaxFocalError = 0.15;

/// Difference between a measured view and the view of a tilted camera with square pixels. A view
/// consists of the members of PaperScale, with the perspective multiplied by the reach (half the
/// diagonal of the image).
struct TiltResidual {
    std::array<double, 5> seen;
    Eigen::MatrixXd whitening;

    /// `tilt` contains mm per px, angle about x, angle about y, and reach / focal length.
    template <typename T>
    bool operator()(const T* tilt, T* residual) const {
        using std::cos;
        using std::sin;
        using std::sqrt;
        const T cx = cos(tilt[1]);
        const T sx = sin(tilt[1]);
        const T cy = cos(tilt[2]);
        const T sy = sin(tilt[2]);
        // The axes of the paper are defined as in simulate.hpp: s = (cy, sx sy, -cx sy) and t = (0,
        // cx, sx). At the centre, one px to the right is (s, t) = mm per px * (1, -sx sy / cx) /
        // cy, and one px down is mm per px * (0, 1 / cx). The x axis of the paper is then rotated
        // onto the first vector.
        const T right_s = 1.0 / cy;
        const T right_t = -sx * sy / (cx * cy);
        const T down_t = 1.0 / cx;
        const T length = sqrt(right_s * right_s + right_t * right_t);
        const T down_along = down_t * right_t / length;
        const T down_across = down_t * right_s / length;
        // The depth is 1 + (z_s s + z_t t) / distance. The divisor of the view is the inverse of
        // the depth, so the perspective has the opposite sign.
        const T per_px_u = tilt[3] * (-cx * sy * right_s + sx * right_t);
        const T per_px_v = tilt[3] * (sx * down_t);
        const T view[5] = {tilt[0] * length, tilt[0] * down_across, down_along / length, -per_px_u,
                           -per_px_v};
        for (std::size_t i = 0; i < 5; ++i) {
            residual[i] = T(0);
            for (std::size_t j = 0; j < 5; ++j)
                residual[i] += whitening(Eigen::Index(i), Eigen::Index(j)) * (view[j] - seen[j]);
        }
        return true;
    }
};

/// Position of the image centre (x, y in mm), and direction of the image x axis there (radians).
using CentrePose = std::array<double, 3>;

/// Returns the pose of the image centre of `camera` relative to the view of `other`. Like
/// `with_camera`, aligns the two views by the shift, rotation and scale that minimise their
/// differences at the same pixels.
CentrePose centre_pose(const Camera& camera, const Camera& other) {
    using Point = std::complex<double>;
    const auto seen = [](const Camera& by, PixelPoint straight) {
        const CameraPoint at = on_paper(by, straight);
        return Point(at.x_mm, at.y_mm);
    };
    constexpr int kParts = 16;
    std::vector<std::pair<Point, Point>> points;
    for (int i = 0; i < kParts * kParts; ++i) {
        const PixelPoint pixel{(i % kParts + 0.5) / kParts * camera.width_px - 0.5,
                               (i / kParts + 0.5) / kParts * camera.height_px - 0.5};
        points.emplace_back(seen(camera, undistorted(camera, pixel)),
                            seen(other, undistorted(other, pixel)));
    }
    Point from;
    Point to;
    for (const auto& [a, b] : points) {
        from += a / double{kParts * kParts};
        to += b / double{kParts * kParts};
    }
    Point product;
    double squares = 0;
    for (const auto& [a, b] : points) {
        product += std::conj(a - from) * (b - to);
        squares += std::norm(a - from);
    }
    const Point turn = product / squares;
    const PixelPoint centre{(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
    const Point at = to + turn * (seen(camera, centre) - from);
    return {at.real(), at.imag(), std::arg(turn) + image_axis_rad(camera, centre)};
}

/// Returns the camera with one of the parameters covered by `LensFit::mounted_covariance` changed
/// by `step`.
Camera with_moved(Camera camera, Eigen::Index parameter, double step, double reach_px) {
    PaperScale& paper = camera.paper.value();
    const std::array<double*, 8> values = {
        &camera.k_per_px2,  &camera.centre_px.u, &camera.centre_px.v,  &paper.mm_per_px_x,
        &paper.mm_per_px_y, &paper.skew,         &paper.perspective_u, &paper.perspective_v};
    const std::array units = {
        1 / (reach_px * reach_px), 1.0, 1.0, 1.0, 1.0, 1.0, 1 / reach_px, 1 / reach_px};
    const auto i = static_cast<std::size_t>(parameter);
    *values[i] += step * units[i];
    return camera;
}

}  // namespace

void describe_mounted(const LensFit& fit, double reach_px, Camera& camera) {
    const auto& paper = fit.camera.paper;
    const auto& sigma = fit.sigma.paper;
    camera.paper =
        PaperScale{paper[0], paper[1], paper[2], paper[3] / reach_px, paper[4] / reach_px};
    camera.sigma["mm_per_px_x"] = sigma[0];
    camera.sigma["mm_per_px_y"] = sigma[1];
    camera.sigma["skew"] = sigma[2];
    camera.sigma["perspective_u_per_px"] = sigma[3] / reach_px;
    camera.sigma["perspective_v_per_px"] = sigma[4] / reach_px;
    const double perspective_sigmas = std::hypot(paper[3] / sigma[3], paper[4] / sigma[4]);
    constexpr double kBeyondDoubt = 5;
    if (!(perspective_sigmas > kBeyondDoubt)) return;

    const auto residual =
        new TiltResidual{paper, whitening_of(fit.mounted_covariance.bottomRightCorner(5, 5))};
    // Initial values. The perspective is approximately the tilt divided by the focal length. A
    // typical ratio of reach to focal length is 0.5.
    std::array tilt{std::sqrt(paper[0] * paper[1]), -2 * paper[4], 2 * paper[3], 0.5};
    ceres::Problem problem;
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<TiltResidual, 5, 4>(residual), nullptr,
                             tilt.data());
    ceres::Solver::Options options;
    options.logging_type = ceres::SILENT;
    options.max_num_iterations = 200;
    options.function_tolerance = 1e-12;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    const Eigen::MatrixXd covariance = normal_inverse(problem, {tilt.data()});
    const double fraction = std::sqrt(covariance(3, 3)) / std::abs(tilt[3]);
    if (!(tilt[3] > 0 && fraction < kMaxFocalError)) return;
    camera.focal_px = reach_px / tilt[3];
    camera.sigma["focal_px"] = *camera.focal_px * fraction;
    camera.tilt = Tilt{tilt[1], tilt[2]};
    camera.sigma["tilt_x_rad"] = std::sqrt(covariance(1, 1));
    camera.sigma["tilt_y_rad"] = std::sqrt(covariance(2, 2));
}

void describe_centre(const LensFit& fit, double reach_px, Camera& camera) {
    // Finite-difference step, in standard deviations of a parameter. The step is small enough that
    // the derivatives with respect to all parameters are accurate.
    constexpr double kStep_sigmas = 0.01;
    const CentrePose here = centre_pose(camera, camera);
    Eigen::MatrixXd derivative(3, 8);
    for (Eigen::Index i = 0; i < 8; ++i) {
        const double step = kStep_sigmas * std::sqrt(fit.mounted_covariance(i, i));
        const CentrePose moved = centre_pose(with_moved(camera, i, step, reach_px), camera);
        for (std::size_t k = 0; k < 3; ++k)
            derivative(Eigen::Index(k), i) = (moved[k] - here[k]) / step;
    }
    const Eigen::MatrixXd covariance = propagated(derivative, fit.mounted_covariance);
    camera.sigma["image_centre_mm"] = std::sqrt((covariance(0, 0) + covariance(1, 1)) / 2);
    camera.sigma["image_axis_rad"] = std::sqrt(covariance(2, 2));
}

void describe_handheld(const LensFit& fit, double reach_px, Camera& camera) {
    const double reach_per_focal = fit.camera.shape[0];
    const double fraction = fit.sigma.shape[0] / reach_per_focal;
    if (!(reach_per_focal > 0 && fraction < kMaxFocalError)) return;
    camera.focal_px = reach_px / reach_per_focal;
    camera.sigma["focal_px"] = *camera.focal_px * fraction;
}

}  // namespace dotpose::calibrate
