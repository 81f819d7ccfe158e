#include <algorithm>
#include <cmath>

#include "dotpose/tools/simulate.hpp"

namespace dotpose {
namespace {

constexpr Vec2 kInvisible{1e9, 1e9};

/// Returns the distorted position of an undistorted point, in px from the centre of distortion.
/// Inverts the lens model (paper, equation 2) by solving k |r_u| |r_d|^2 - |r_d| + |r_u| = 0 for
/// r_d. Selects the root that equals r_u for k = 0.
Vec2 distorted(Vec2 undistorted, double k) {
    const double square = undistorted.x * undistorted.x + undistorted.y * undistorted.y;
    const double discriminant = 1 - 4 * k * square;
    if (discriminant < 0) return kInvisible;
    const double scale = 2 / (1 + std::sqrt(discriminant));
    return {scale * undistorted.x, scale * undistorted.y};
}

Vec2 rotated(Vec2 v, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

}  // namespace

Projection::Projection(const CameraModel& camera, const CameraPose& pose)
    : centre_px_{(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0},
      height_px_(camera.height_px),
      readout_px_(camera.readout_px),
      readout_turn_rad_(camera.readout_turn_rad),
      k_(camera.k),
      focal_px_(camera.working_distance_mm / camera.mm_per_px),
      distance_mm_(camera.working_distance_mm) {
    // s and t are coordinates on the paper. Before the tilt, their axes are parallel to the image
    // axes. The tilt rotates them first about the image y axis, then about the image x axis.
    const double cx = std::cos(pose.tilt_x_rad);
    const double sx = std::sin(pose.tilt_x_rad);
    const double cy = std::cos(pose.tilt_y_rad);
    const double sy = std::sin(pose.tilt_y_rad);
    const std::array<double, 3> s_axis{cy, sx * sy, -cx * sy};
    const std::array<double, 3> t_axis{0, cx, sx};

    // At the pose point, a step along the image x axis corresponds to a step (s, t) on the paper,
    // where s * s_axis + t * t_axis = (1, 0, z) for some z. Theta is the angle of this step in the
    // pattern.
    const double step_angle_rad = std::atan2(-sx * sy / cx, 1);
    const double turn_rad = pose.theta_rad - step_angle_rad;
    const double c = std::cos(turn_rad);
    const double s = std::sin(turn_rad);
    for (std::size_t i = 0; i < 3; ++i) {
        // An offset in the pattern is R(turn) * (s, t), where R is a rotation. In the coordinates
        // (s, t), the axes of the pattern are therefore the columns of R(-turn).
        x_axis_[i] = c * s_axis[i] - s * t_axis[i];
        y_axis_[i] = s * s_axis[i] + c * t_axis[i];
    }
}

Vec2 Projection::moved(Vec2 undistorted, double time) const {
    const Vec2 turned =
        readout_turn_rad_ == 0 ? undistorted : rotated(undistorted, time * readout_turn_rad_);
    const Vec2 way = way_at(time);
    return {turned.x + way.x, turned.y + way.y};
}

Vec2 Projection::way_at(double time) const {
    const Vec2 way{time * readout_px_.x, time * readout_px_.y};
    const double half_rad = time * readout_turn_rad_ / 2;
    if (half_rad == 0) return way;
    const Vec2 chord = rotated(way, half_rad);
    const double shorter = std::sin(half_rad) / half_rad;
    return {shorter * chord.x, shorter * chord.y};
}

Vec2 Projection::pixel_from_offset(Vec2 offset_mm) const {
    const auto camera_mm = [&](std::size_t i) {
        return x_axis_[i] * offset_mm.x + y_axis_[i] * offset_mm.y;
    };
    const double depth_mm = distance_mm_ + camera_mm(2);
    if (depth_mm <= 0) return kInvisible;
    const Vec2 undistorted{focal_px_ * camera_mm(0) / depth_mm,
                           focal_px_ * camera_mm(1) / depth_mm};
    // The scene moves while the rows are read, so the row that shows a point depends on the time,
    // and the time depends on the row. Newton's method solves row = seen_at(row).y. If the scene
    // does not rotate and the lens has no distortion, the first step is exact.
    const auto seen_at = [&](double row_px) {
        return distorted(moved(undistorted, row_px / height_px_), k_);
    };
    double row_px = 0;
    Vec2 seen = seen_at(row_px);
    const bool is_turning = readout_turn_rad_ != 0;
    const bool is_rolling = is_turning || readout_px_.x != 0 || readout_px_.y != 0;
    const int steps = is_turning ? 40 : 12;
    for (int i = 0; is_rolling && i < steps && seen.x < kInvisible.x; ++i) {
        constexpr double kStep_px = 1e-3;
        const double slope = (seen_at(row_px + kStep_px).y - seen.y) / kStep_px;
        row_px += (seen.y - row_px) / (1 - slope);
        // If the scene rotates, a point far outside the image may be visible in several rows or in
        // none. Newton's method may then diverge, so the row is clamped.
        if (is_turning) row_px = std::clamp(row_px, -height_px_, height_px_);
        seen = seen_at(row_px);
    }
    constexpr double kMaxError_px = 1e-6;
    if (is_turning && std::abs(seen.y - row_px) > kMaxError_px) return kInvisible;
    return seen.x < kInvisible.x ? Vec2{centre_px_.x + seen.x, centre_px_.y + seen.y} : kInvisible;
}

Vec2 Projection::offset_from_pixel(Vec2 pixel) const {
    const double time = (pixel.y - centre_px_.y) / height_px_;
    const double dx = pixel.x - centre_px_.x;
    const double dy = pixel.y - centre_px_.y;
    const double scale = 1 / (focal_px_ * (1 + k_ * (dx * dx + dy * dy)));  // paper, equation 2
    // The viewing ray is (rx, ry, 1) * depth. It meets the paper at the offset (ox, oy), where
    // depth = distance + z. Therefore
    // x_axis.xy * ox + y_axis.xy * oy = (rx, ry) * (distance + x_axis.z * ox + y_axis.z * oy).
    double rx = dx * scale - time * (readout_px_.x / focal_px_);
    double ry = dy * scale - time * (readout_px_.y / focal_px_);
    if (readout_turn_rad_ != 0) {
        const Vec2 way = way_at(time);
        const Vec2 before =
            rotated({dx * scale - way.x / focal_px_, dy * scale - way.y / focal_px_},
                    -time * readout_turn_rad_);
        rx = before.x;
        ry = before.y;
    }
    const double a = x_axis_[0] - rx * x_axis_[2];
    const double b = y_axis_[0] - rx * y_axis_[2];
    const double c = x_axis_[1] - ry * x_axis_[2];
    const double d = y_axis_[1] - ry * y_axis_[2];
    const double factor = distance_mm_ / (a * d - b * c);
    return {(d * rx - b * ry) * factor, (a * ry - c * rx) * factor};
}

// Inlining all calls halves the run time of this function.
[[gnu::flatten]] void Projection::offsets_from_row(Vec2 first_pixel,
                                                   std::span<Vec2> offsets_mm) const {
    for (std::size_t i = 0; i < offsets_mm.size(); ++i)
        offsets_mm[i] = offset_from_pixel({first_pixel.x + static_cast<double>(i), first_pixel.y});
}

}  // namespace dotpose
