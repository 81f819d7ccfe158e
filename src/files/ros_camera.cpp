#include "files/ros_camera.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "files/division_model.hpp"

namespace dotpose::files {
namespace {

/// Maximum rms difference over the image, in px, between the division model (paper, equation 2) and
/// the plumb_bob model that it replaces.
constexpr double kMaxMisfit_px = 0.5;

/// Maximum focal length and centre coordinate, in px, and maximum distortion coefficient. The
/// limits are far above the values of real cameras. Larger values could overflow in the fit.
constexpr double kMaxPx = 1e6;
constexpr double kMaxDistortion = 1e3;

/// Returns the list under one of three keys. Files written by camera_calibration_parsers use the
/// key `nested`. Printed messages use `lower` or `upper`.
std::vector<double> coefficients(const YamlMap& file, const char* nested, const char* lower,
                                 const char* upper, std::size_t count) {
    if (file.has(nested)) return file.map(nested).numbers("data", count);
    return file.numbers(file.has(lower) ? lower : file.has(upper) ? upper : nested, count);
}

/// Name of the plumb_bob model extended by a divisor with the coefficients k4 to k6. Some drivers
/// report this model for every camera.
constexpr const char* kRational = "rational_polynomial";

/// Returns the plumb_bob coefficients of a rational polynomial. Throws Error unless the other
/// coefficients (k4 to k6, thin prism, tilted sensor) are 0.
std::vector<double> without_rational_terms(const YamlMap& file, std::vector<double> d) {
    constexpr std::size_t kPlumbBob = 5;
    const auto is_set = [](double k) { return k != 0; };
    if (d.size() <= kPlumbBob) return d;
    if (std::any_of(d.begin() + kPlumbBob, d.end(), is_set)) {
        file.fail("distortion_model",
                  fmt::format("is '{}' with k4 to k6 other than 0, which cannot be read: use "
                              "'dotpose calibrate'",
                              kRational));
    }
    d.resize(kPlumbBob);
    return d;
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
    if (model != "plumb_bob" && model != kRational) {
        file.fail(
            "distortion_model",
            fmt::format("is '{}'; only plumb_bob can be read: use 'dotpose calibrate'", model));
    }
    const auto matrix = coefficients(file, "camera_matrix", "k", "K", 9);
    const char* matrix_key = file.has("camera_matrix") ? "camera_matrix"
                             : file.has("k")           ? "k"
                                                       : "K";
    if (!(matrix[0] > 0 && matrix[4] > 0)) {
        file.fail(matrix_key, "has no focal lengths above 0: this camera was never calibrated");
    }
    const auto is_focal = [](double px) { return px >= 1 && px <= kMaxPx; };
    const auto is_centre = [](double px) { return std::abs(px) <= kMaxPx; };
    if (!is_focal(matrix[0]) || !is_focal(matrix[4]) || !is_centre(matrix[2]) ||
        !is_centre(matrix[5])) {
        file.fail(matrix_key, "has focal lengths, or a centre, that no camera has");
    }
    auto d = coefficients(file, "distortion_coefficients", "d", "D", 0);
    if (model == kRational) d = without_rational_terms(file, std::move(d));
    if (d.size() != 4 && d.size() != 5) {
        file.fail("distortion_coefficients", "must be k1, k2, t1, t2 and k3");
    }
    if (std::ranges::any_of(d, [](double k) { return std::abs(k) > kMaxDistortion; })) {
        file.fail("distortion_coefficients", "are larger than those of any lens");
    }
    d.resize(5);
    const PlumbBob lens{matrix[0], matrix[4], matrix[2], matrix[5], d[0], d[1], d[2], d[3], d[4]};
    camera.focal_px = std::sqrt(lens.fx * lens.fy);
    const double misfit_px = fit_division_model(lens, camera);
    if (!(misfit_px <= kMaxMisfit_px)) {
        file.fail("distortion_coefficients",
                  fmt::format("describe a lens that one coefficient cannot represent (the error "
                              "would be {:.1f} px): use 'dotpose calibrate'",
                              misfit_px));
    }
    return camera;
}

}  // namespace dotpose::files
