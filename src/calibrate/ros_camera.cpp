#include "calibrate/ros_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <ceres/ceres.h>
#include <fmt/core.h>

namespace dotpose::calibrate {
namespace {

/// What eq. 2 may be off plumb_bob, rms over the image.
constexpr double kLargestMisfit_px = 0.5;

/// Focal lengths, centres and distortion coefficients of cameras are far below these; a fit to
/// larger ones may overflow.
constexpr double kMostPx = 1e6;
constexpr double kMostDistortion = 1e3;

/// http://docs.ros.org/en/api/sensor_msgs/html/msg/CameraInfo.html, plumb_bob: the lens of OpenCV,
/// which leads from the undistorted to the distorted image.
struct PlumbBob {
    double fx = 0;
    double fy = 0;
    double cx = 0;
    double cy = 0;
    double k1 = 0;
    double k2 = 0;
    double t1 = 0;
    double t2 = 0;
    double k3 = 0;

    /// By fixed-point iteration, as there is no closed inverse.
    PixelPoint undistorted(PixelPoint pixel) const {
        const double xd = (pixel.u - cx) / fx;
        const double yd = (pixel.v - cy) / fy;
        double x = xd;
        double y = yd;
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
};

/// affine(eq. 2(pixel)) - wanted. What is affine, the fit of every pose takes up by itself.
struct Misfit {
    PixelPoint pixel;
    PixelPoint wanted;
    double reach_px;

    template <typename T>
    bool operator()(const T* k, const T* centre, const T* affine, T* residual) const {
        const T u = (pixel.u - centre[0]) / reach_px;
        const T v = (pixel.v - centre[1]) / reach_px;
        const T shrink = 1.0 / (1.0 + k[0] * (u * u + v * v));
        const T x = shrink * u;
        const T y = shrink * v;
        residual[0] = affine[0] + affine[1] * x + affine[2] * y - wanted.u;
        residual[1] = affine[3] + affine[4] * x + affine[5] * y - wanted.v;
        return true;
    }
};

/// Sets k and centre to what is nearest to `lens` all over the image. Returns the rms misfit.
double fit_division_model(const PlumbBob& lens, Camera& camera) {
    constexpr int kSteps = 16;
    const double reach_px = std::hypot(camera.width_px, camera.height_px) / 2;
    double k = 0;
    std::array centre{lens.cx, lens.cy};
    std::array affine{lens.cx, reach_px, 0.0, lens.cy, 0.0, reach_px};
    ceres::Problem problem;
    std::vector<Misfit> misfits;
    for (int j = 0; j <= kSteps; ++j) {
        for (int i = 0; i <= kSteps; ++i) {
            const PixelPoint pixel{(camera.width_px - 1.0) * i / kSteps,
                                   (camera.height_px - 1.0) * j / kSteps};
            const PixelPoint wanted = lens.undistorted(pixel);
            if (!(std::abs(wanted.u) <= kMostPx && std::abs(wanted.v) <= kMostPx)) {
                return std::numeric_limits<double>::infinity();  // the iteration does not converge
            }
            misfits.push_back({pixel, wanted, reach_px});
            problem.AddResidualBlock(
                new ceres::AutoDiffCostFunction<Misfit, 2, 1, 2, 6>(new Misfit(misfits.back())),
                nullptr, &k, centre.data(), affine.data());
        }
    }
    // Without distortion nothing tells where its centre is.
    const bool is_straight =
        lens.k1 == 0 && lens.k2 == 0 && lens.k3 == 0 && lens.t1 == 0 && lens.t2 == 0;
    if (is_straight) problem.SetParameterBlockConstant(centre.data());
    ceres::Solver::Options options;
    options.logging_type = ceres::SILENT;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 200;
    options.function_tolerance = 1e-12;
    options.parameter_tolerance = 1e-12;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    camera.k_per_px2 = k / (reach_px * reach_px);
    camera.centre_px = {centre[0], centre[1]};
    double squares = 0;
    for (const Misfit& misfit : misfits) {
        std::array<double, 2> residual{};
        misfit(&k, centre.data(), affine.data(), residual.data());
        squares += residual[0] * residual[0] + residual[1] * residual[1];
    }
    return std::sqrt(squares / static_cast<double>(misfits.size()));
}

/// The list under a key of camera_calibration_parsers' matrices, or of a printed message.
std::vector<double> coefficients(const YamlMap& file, const char* nested, const char* lower,
                                 const char* upper, std::size_t count) {
    if (file.has(nested)) return file.map(nested).numbers("data", count);
    return file.numbers(file.has(lower) ? lower : file.has(upper) ? upper : nested, count);
}

}  // namespace

bool is_camera_info(const YamlMap& file) {
    return file.has("distortion_model") || file.has("camera_matrix") ||
           file.has("distortion_coefficients");
}

Camera camera_from_camera_info(const YamlMap& file) {
    Camera camera;
    camera.width_px = file.integer(file.has("width") ? "width" : "image_width");
    camera.height_px = file.integer(file.has("height") ? "height" : "image_height");
    const std::string model = file.text("distortion_model");
    if (model != "plumb_bob") {
        file.fail("distortion_model", fmt::format("is '{}'; only plumb_bob can be read", model));
    }
    const auto matrix = coefficients(file, "camera_matrix", "k", "K", 9);
    const char* matrix_key = file.has("camera_matrix") ? "camera_matrix"
                             : file.has("k")           ? "k"
                                                       : "K";
    if (!(matrix[0] > 0 && matrix[4] > 0)) {
        file.fail(matrix_key, "has no focal lengths above 0: this camera was never calibrated");
    }
    const auto is_focal = [](double px) { return px >= 1 && px <= kMostPx; };
    const auto is_centre = [](double px) { return std::abs(px) <= kMostPx; };
    if (!is_focal(matrix[0]) || !is_focal(matrix[4]) || !is_centre(matrix[2]) ||
        !is_centre(matrix[5])) {
        file.fail(matrix_key, "has focal lengths, or a centre, that no camera has");
    }
    auto d = coefficients(file, "distortion_coefficients", "d", "D", 0);
    if (d.size() != 4 && d.size() != 5) {
        file.fail("distortion_coefficients", "must be k1, k2, t1, t2 and k3");
    }
    if (std::ranges::any_of(d, [](double k) { return std::abs(k) > kMostDistortion; })) {
        file.fail("distortion_coefficients", "are larger than those of any lens");
    }
    d.resize(5);
    const PlumbBob lens{matrix[0], matrix[4], matrix[2], matrix[5], d[0], d[1], d[2], d[3], d[4]};
    camera.focal_px = std::sqrt(lens.fx * lens.fy);
    const double misfit_px = fit_division_model(lens, camera);
    if (!(misfit_px <= kLargestMisfit_px)) {
        file.fail(
            "distortion_coefficients",
            fmt::format("describe a lens that one coefficient cannot follow (it would be {:.1f} "
                        "px off): use 'dotpose calibrate'",
                        misfit_px));
    }
    return camera;
}

}  // namespace dotpose::calibrate
