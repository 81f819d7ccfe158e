// Camera geometry: validation, lens distortion, the map from the image to the paper, crops, and
// locator options.
#include "dotpose/files/camera.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <fmt/core.h>

#include "dotpose/locate.hpp"

namespace dotpose {
namespace {

constexpr double kMaxCentre_px = 1000;
/// Maximum distance of the reference point from the image centre. It is larger than any image side,
/// but small enough to keep the fixed-point pose from overflowing.
constexpr double kMaxReference_px = 10'000;
constexpr double kMaxFocal_px = 1e6;
constexpr double kMinStretch = 0.5;
constexpr double kMaxStretch = 2;

/// Position along an axis with equidistant sample points, for linear interpolation between the two
/// adjacent points.
struct Between {
    std::size_t first;  ///< index of the point at or before the position, in [0, `count` - 2]
    double part;        ///< fraction of the distance from this point to the next point, in [0, 1]
};

Between between(double at_px, int side_px, std::size_t count) {
    const double at = at_px * double(count - 1) / double(side_px - 1);
    const std::size_t first = std::min(static_cast<std::size_t>(at), count - 2);
    return {first, at - double(first)};
}

PixelPoint image_centre(const Camera& camera) {
    return {(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
}

void require(bool is_good, const char* key, const std::string& why) {
    if (!is_good) throw BadArgument(fmt::format("{} {}", key, why));
}

void require_near(PixelPoint point, const Camera& camera, double limit_px, const char* key) {
    const PixelPoint middle = image_centre(camera);
    const bool is_near =
        std::abs(point.u - middle.u) <= limit_px && std::abs(point.v - middle.v) <= limit_px;
    require(is_near, key, fmt::format("is more than {} px off the image centre", limit_px));
}

void require_lens(const Camera& camera) {
    const double last_u = camera.width_px - 1;
    const double last_v = camera.height_px - 1;
    for (const double u : {0.0, last_u}) {
        for (const double v : {0.0, last_v}) {
            const double du = u - camera.centre_px.u;
            const double dv = v - camera.centre_px.v;
            const double stretch = 1 + camera.k_per_px2 * (du * du + dv * dv);
            require(stretch >= kMinStretch && stretch <= kMaxStretch, "k_per_px2",
                    fmt::format("{:g} folds an image of {} x {} px", camera.k_per_px2,
                                camera.width_px, camera.height_px));
        }
    }
}

void require_paper(const PaperScale& paper, const Camera& camera) {
    // The limits cover everything from microscopes to cameras on the ceiling of a large hall.
    const auto is_length = [](double mm) { return mm >= 1e-6 && mm <= 1e3; };
    require(is_length(paper.mm_per_px_x) && is_length(paper.mm_per_px_y), "mm_per_px",
            "must be from 0.000001 to 1000");
    require(std::abs(paper.skew) <= 0.5, "skew", "must be from -0.5 to 0.5");
    // The horizon, where the divisor of `on_paper` is 0, must be far outside the image.
    const double max_u =
        std::max(std::abs(camera.centre_px.u), std::abs(camera.width_px - 1 - camera.centre_px.u));
    const double max_v =
        std::max(std::abs(camera.centre_px.v), std::abs(camera.height_px - 1 - camera.centre_px.v));
    const double change =
        std::abs(paper.perspective_u) * max_u + std::abs(paper.perspective_v) * max_v;
    require(change <= 0.75, "perspective_per_px", "puts the horizon into the image");
}

void require_tip(const PenTip& tip) {
    constexpr double kMaxTip_mm = 10'000;
    for (const double mm : {tip.x_mm, tip.y_mm, tip.z_mm}) {
        require(std::abs(mm) <= kMaxTip_mm, "tip_mm",
                fmt::format("must be within {:g} mm of the camera", kMaxTip_mm));
    }
    require(std::abs(tip.rest_mm) <= kMaxTip_mm, "tip_rest_mm",
            fmt::format("must be at most {:g} mm", kMaxTip_mm));
}

void require_flat_field(const Camera& camera) {
    const auto is_side = [](std::size_t values, int side_px) {
        return values >= 2 && values <= static_cast<std::size_t>(side_px);
    };
    const std::size_t columns = camera.flat_field.front().size();
    require(
        is_side(camera.flat_field.size(), camera.height_px) && is_side(columns, camera.width_px),
        "flat_field", "must have 2 or more rows and columns, and not more than the image");
    for (const std::vector<double>& row : camera.flat_field) {
        require(row.size() == columns, "flat_field", "must have rows of the same length");
        require(std::all_of(row.begin(), row.end(),
                            [](double b) { return b >= kMinFlatField && b <= 1; }),
                "flat_field", fmt::format("must have values from {:g} to 1", kMinFlatField));
    }
}

}  // namespace

void validate(const Camera& camera) {
    const auto is_side = [](int px) {
        return px >= kMinKnownFrameSide_px && px <= kMaxFrameSide_px;
    };
    const auto side_range =
        fmt::format("must be {} to {}", kMinKnownFrameSide_px, kMaxFrameSide_px);
    require(is_side(camera.width_px), "width_px", side_range);
    require(is_side(camera.height_px), "height_px", side_range);
    require_near(camera.centre_px, camera, kMaxCentre_px, "centre_px");
    require_lens(camera);
    if (camera.paper) require_paper(*camera.paper, camera);
    if (camera.focal_px) {
        require(*camera.focal_px >= 1 && *camera.focal_px <= kMaxFocal_px, "focal_px",
                fmt::format("must be from 1 to {:g}", kMaxFocal_px));
    }
    if (camera.pinhole) {
        const auto is_focal = [](double px) { return px >= 1 && px <= kMaxFocal_px; };
        require(is_focal(camera.pinhole->focal_u_px) && is_focal(camera.pinhole->focal_v_px),
                "pinhole_px", fmt::format("must have focal lengths from 1 to {:g}", kMaxFocal_px));
        require_near(camera.pinhole->centre_px, camera, kMaxCentre_px, "pinhole_px");
    }
    if (camera.tilt) {
        const auto is_tilt = [](double rad) { return std::abs(rad) < std::numbers::pi / 2; };
        require(is_tilt(camera.tilt->x_rad) && is_tilt(camera.tilt->y_rad), "tilt_rad",
                "must be below a quarter turn");
    }
    if (camera.reference_px) {
        require_near(*camera.reference_px, camera, kMaxReference_px, "reference_px");
    }
    require(std::abs(camera.theta_offset_rad) <= 2 * std::numbers::pi, "theta_offset_rad",
            "must be at most a full turn");
    if (camera.tip) require_tip(*camera.tip);
    if (!camera.flat_field.empty()) require_flat_field(camera);
    if (camera.readout_ms) {
        constexpr double kMaxReadout_ms = 10'000;
        require(*camera.readout_ms > 0 && *camera.readout_ms <= kMaxReadout_ms, "readout_ms",
                fmt::format("must be above 0, and at most {:g}", kMaxReadout_ms));
    }
    if (camera.exposure_us) {
        require(*camera.exposure_us > 0 && std::isfinite(*camera.exposure_us), "exposure_us",
                "must be above 0");
    }
    if (camera.gain) {
        require(*camera.gain > 0 && std::isfinite(*camera.gain), "gain", "must be above 0");
    }
}

PixelPoint undistorted(const Camera& camera, PixelPoint pixel) {
    const double du = pixel.u - camera.centre_px.u;
    const double dv = pixel.v - camera.centre_px.v;
    const double shrink = 1 / (1 + camera.k_per_px2 * (du * du + dv * dv));
    return {camera.centre_px.u + shrink * du, camera.centre_px.v + shrink * dv};
}

PixelPoint distorted(const Camera& camera, PixelPoint point) {
    const double du = point.u - camera.centre_px.u;
    const double dv = point.v - camera.centre_px.v;
    // Solves the lens model (paper, equation 2) for r_d. The equation is quadratic, and the result
    // is the root that equals r_u if k is 0.
    const double root = std::sqrt(std::max(1 - 4 * camera.k_per_px2 * (du * du + dv * dv), 0.0));
    const double stretch = 2 / (1 + root);
    return {camera.centre_px.u + stretch * du, camera.centre_px.v + stretch * dv};
}

std::optional<Pinhole> pinhole_of(const Camera& camera) {
    if (camera.pinhole) return camera.pinhole;
    if (!camera.focal_px) return std::nullopt;
    return Pinhole{*camera.focal_px, *camera.focal_px, camera.centre_px};
}

CameraPoint on_paper(const Camera& camera, PixelPoint point) {
    const PaperScale& paper = camera.paper.value();
    const double a = point.u - camera.centre_px.u;
    const double b = point.v - camera.centre_px.v;
    const double divisor = 1 + paper.perspective_u * a + paper.perspective_v * b;
    return {paper.mm_per_px_x * (a + paper.skew * b) / divisor, paper.mm_per_px_y * b / divisor};
}

PixelPoint on_image(const Camera& camera, CameraPoint point) {
    const PaperScale& paper = camera.paper.value();
    // `on_paper` divides (a, b) by `divisor` to get (flat_a, flat_b). Because the divisor is linear
    // in a and b, it can be computed from flat_a and flat_b.
    const double flat_b = point.y_mm / paper.mm_per_px_y;
    const double flat_a = point.x_mm / paper.mm_per_px_x - paper.skew * flat_b;
    const double divisor = 1 / (1 - paper.perspective_u * flat_a - paper.perspective_v * flat_b);
    return {camera.centre_px.u + divisor * flat_a, camera.centre_px.v + divisor * flat_b};
}

double image_axis_rad(const Camera& camera, PixelPoint point) {
    const CameraPoint from = on_paper(camera, {point.u - 0.5, point.v});
    const CameraPoint to = on_paper(camera, {point.u + 0.5, point.v});
    return std::atan2(to.y_mm - from.y_mm, to.x_mm - from.x_mm);
}

CameraPoint from_image_centre(const Camera& camera, PixelPoint point) {
    const CameraPoint middle = on_paper(camera, image_centre(camera));
    const CameraPoint at = on_paper(camera, point);
    const double angle = image_axis_rad(camera, image_centre(camera));
    const double x = at.x_mm - middle.x_mm;
    const double y = at.y_mm - middle.y_mm;
    return {std::cos(angle) * x + std::sin(angle) * y, std::cos(angle) * y - std::sin(angle) * x};
}

PixelPoint pixel_from_image_centre(const Camera& camera, CameraPoint point) {
    const CameraPoint middle = on_paper(camera, image_centre(camera));
    const double angle = image_axis_rad(camera, image_centre(camera));
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return on_image(camera, {middle.x_mm + c * point.x_mm - s * point.y_mm,
                             middle.y_mm + s * point.x_mm + c * point.y_mm});
}

std::optional<PixelPoint> reference_in(const Camera& other, const Camera& camera) {
    if (!camera.reference_px || !camera.paper || !other.paper) return camera.reference_px;
    return pixel_from_image_centre(other, from_image_centre(camera, *camera.reference_px));
}

double brightness_at(const Camera& camera, PixelPoint pixel) {
    const auto& field = camera.flat_field;
    const Between u = between(pixel.u, camera.width_px, field.front().size());
    const Between v = between(pixel.v, camera.height_px, field.size());
    const auto along_row = [&](const std::vector<double>& row) {
        return std::lerp(row[u.first], row[u.first + 1], u.part);
    };
    return std::lerp(along_row(field[v.first]), along_row(field[v.first + 1]), v.part);
}

Camera part_of(const Camera& camera, int left_px, int top_px, int width_px, int height_px) {
    if (left_px < 0 || top_px < 0 || left_px > camera.width_px - width_px ||
        top_px > camera.height_px - height_px) {
        throw BadArgument(fmt::format("the part {},{} {}x{} leaves the camera's images of {}x{} px",
                                      left_px, top_px, width_px, height_px, camera.width_px,
                                      camera.height_px));
    }
    const auto moved = [&](PixelPoint pixel) {
        return PixelPoint{pixel.u - left_px, pixel.v - top_px};
    };
    Camera part = camera;
    part.width_px = width_px;
    part.height_px = height_px;
    part.centre_px = moved(camera.centre_px);
    if (camera.pinhole) part.pinhole->centre_px = moved(camera.pinhole->centre_px);
    part.reference_px = moved(camera.reference_px.value_or(image_centre(camera)));
    if (camera.paper) {
        // The heading is relative to the image x axis at the image centre. The cropped image has a
        // different centre, so the offset changes.
        part.theta_offset_rad +=
            image_axis_rad(camera, image_centre(camera)) - image_axis_rad(part, image_centre(part));
    }
    if (camera.readout_ms) part.readout_ms = *camera.readout_ms * height_px / camera.height_px;
    const std::size_t rows = part.flat_field.size();
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t columns = part.flat_field[row].size();
        for (std::size_t column = 0; column < columns; ++column) {
            const double u = double(column) * (width_px - 1) / double(columns - 1);
            const double v = double(row) * (height_px - 1) / double(rows - 1);
            part.flat_field[row][column] = brightness_at(camera, {left_px + u, top_px + v});
        }
    }
    validate(part);
    return part;
}

void use_camera(const Camera& camera, int width_px, int height_px, DeviceOptions& options) {
    if (camera.width_px != width_px || camera.height_px != height_px) {
        throw BadArgument(fmt::format("the camera file is for images of {} x {} px, not {} x {} px",
                                      camera.width_px, camera.height_px, width_px, height_px));
    }
    const PixelPoint middle = image_centre(camera);
    const auto q8 = [](double px) { return static_cast<std::int32_t>(std::lround(px * 256)); };
    options.lens = FixedLens::from_k(camera.k_per_px2);
    options.lens.centre_dx_q8 = q8(camera.centre_px.u - middle.u);
    options.lens.centre_dy_q8 = q8(camera.centre_px.v - middle.v);
    if (camera.paper) options.show_stages = true;  // with_camera needs the dots in the trace
    if (camera.reference_px) {
        options.reference_dx_q8 = q8(camera.reference_px->u - middle.u);
        options.reference_dy_q8 = q8(camera.reference_px->v - middle.v);
    }
}

}  // namespace dotpose
