// Simulates handwriting: the path of a pen, and the frames from the camera in the pen.
#include <array>
#include <cmath>
#include <numbers>

#include "dotpose/tools/random.hpp"
#include "dotpose/tools/simulate_pen.hpp"

namespace dotpose {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr double kDegree_rad = std::numbers::pi / 180;

using Vector = std::array<double, 3>;

Vector about_z(double angle_rad, const Vector& v) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
}

Vector about_y(double angle_rad, const Vector& v) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c * v[0] + s * v[2], v[1], c * v[2] - s * v[0]};
}

/// Rotates a vector from the camera frame to the pattern frame.
Vector on_pattern(const PenPose& pose, const Vector& in_camera) {
    const Vector turned = about_z(pose.turn_rad - pose.azimuth_rad, in_camera);
    return about_z(pose.azimuth_rad, about_y(-pose.tilt_rad, turned));
}

/// Sets the cell and the fractions of `pose` to the given position, in spacings.
void move_to(double x_grid, double y_grid, CameraPose& pose) {
    pose.cell = {static_cast<std::uint32_t>(std::floor(x_grid)),
                 static_cast<std::uint32_t>(std::floor(y_grid))};
    pose.fraction_x = x_grid - std::floor(x_grid);
    pose.fraction_y = y_grid - std::floor(y_grid);
}

/// Returns the position at time `t` on a minimum-jerk path that starts and ends at rest. Time and
/// position range from 0 to 1.
double smooth_step(double t) {
    return t * t * t * (10 + t * (6 * t - 15));
}

/// A stroke with loops, and the pen's move to the next stroke.
struct Stroke {
    double start_x_mm = 0;
    double start_y_mm = 0;
    double duration_s = 0;
    double width_mm = 0;
    double loops = 0;
    double loop_height_mm = 0;
    double loop_width_mm = 0;
    double slant_rad = 0;
    double lift_s = 0;
    double lift_mm = 0;
    bool is_last = false;

    /// Returns the height of the pen during the move after the stroke. `part` is the elapsed
    /// fraction of the move, from 0 to 1. After the last stroke, the pen stays above the paper.
    double height_mm(double part) const {
        return lift_mm * std::sin(std::numbers::pi * (is_last ? part / 2 : part));
    }

    /// Returns the position of the tip on the stroke. `part` is the elapsed fraction of the
    /// stroke's duration, from 0 to 1.
    Vec2 at(double part) const {
        const double s = smooth_step(part);
        const double phase = kTurn_rad * loops * s;
        return {start_x_mm + width_mm * s + loop_width_mm * std::sin(phase + slant_rad) -
                    loop_width_mm * std::sin(slant_rad),
                start_y_mm -
                    loop_height_mm * (1 - std::cos(phase)) / 2 * (1 + 0.3 * std::sin(phase / 3))};
    }
};

std::vector<Stroke> strokes_of(const Handwriting& options) {
    constexpr int kStrokesPerLine = 4;
    constexpr double kLine_mm = 7;
    constexpr double kGap_mm = 1.5;
    Rng rng(options.seed, 1);
    std::vector<Stroke> strokes;
    double x_mm = options.x_mm;
    for (int i = 0; i < options.strokes; ++i) {
        if (i % kStrokesPerLine == 0) x_mm = options.x_mm;
        Stroke stroke;
        stroke.start_x_mm = x_mm;
        stroke.start_y_mm =
            options.y_mm + kLine_mm * (i / kStrokesPerLine) + rng.uniform(-0.3, 0.3);
        stroke.width_mm = rng.uniform(3, 8);
        stroke.loops = rng.uniform(1.5, 4.5);
        stroke.duration_s = 0.22 * stroke.loops;
        stroke.loop_height_mm = rng.uniform(1.5, 3.5);
        stroke.loop_width_mm = rng.uniform(0.3, 0.9);
        stroke.slant_rad = rng.uniform(-0.6, 0.6);
        stroke.lift_s = rng.uniform(0.15, 0.3);
        stroke.lift_mm = rng.uniform(1, 3);
        stroke.is_last = i + 1 == options.strokes;
        strokes.push_back(stroke);
        x_mm += stroke.width_mm + kGap_mm;
    }
    return strokes;
}

/// Sets the angles of the pen at time `t_s`. The angles vary as in natural handwriting.
void lean(double t_s, std::uint64_t seed, PenPose& pose) {
    Rng rng(seed, 2);
    const double phase = rng.uniform(0, kTurn_rad);
    const double around = rng.uniform(0, kTurn_rad);
    pose.tilt_rad = (30 + 9.5 * std::sin(kTurn_rad * 0.8 * t_s + phase)) * kDegree_rad;
    pose.azimuth_rad = (45 + 15 * std::sin(kTurn_rad * 0.5 * t_s + around)) * kDegree_rad;
    pose.turn_rad = 10 * kDegree_rad * std::sin(kTurn_rad * 0.3 * t_s);
}

PenSample sample_at(double t_s, double begin_s, const Stroke& stroke, const Vec2& next,
                    std::uint64_t seed) {
    PenSample sample;
    sample.t_s = t_s;
    const double part = (t_s - begin_s) / stroke.duration_s;
    sample.is_down = part <= 1;
    Vec2 place = stroke.at(std::min(part, 1.0));
    if (!sample.is_down) {
        const double lift = (t_s - begin_s - stroke.duration_s) / stroke.lift_s;
        const double s = smooth_step(lift);
        place = {place.x + s * (next.x - place.x), place.y + s * (next.y - place.y)};
        sample.pose.height_mm = stroke.height_mm(lift);
    }
    sample.pose.x_mm = place.x;
    sample.pose.y_mm = place.y;
    lean(t_s, seed, sample.pose);
    return sample;
}

}  // namespace

Shot shot_of_pen(const Shot& shot, const PenTip& tip, const PenPose& pose) {
    Shot result = shot;
    const double focal_px = shot.camera.working_distance_mm / shot.camera.mm_per_px;
    const Vector to_tip = on_pattern(pose, {tip.x_mm, tip.y_mm, tip.z_mm});
    const Vector axis = on_pattern(pose, {0, 0, 1});
    // z coordinate of the camera. z points into the paper, so it is negative above the paper.
    const double z_mm = -(pose.height_mm + tip.rest_mm) - to_tip[2];
    if (!(axis[2] > 0) || !(z_mm < 0))
        throw BadArgument("the camera of the pen must look down at the paper");
    const double distance_mm = -z_mm / axis[2];
    result.camera.working_distance_mm = distance_mm;
    result.camera.mm_per_px = distance_mm / focal_px;
    const double spacing_mm = shot.page.pattern.spacing_mm;
    move_to((pose.x_mm - to_tip[0] + distance_mm * axis[0]) / spacing_mm,
            (pose.y_mm - to_tip[1] + distance_mm * axis[1]) / spacing_mm, result.pose);
    // Normal of the paper in the camera frame. For the tilts tx and ty about the image axes, the
    // normal is (sin ty, -sin tx cos ty, cos tx cos ty).
    const auto component = [&pose](const Vector& unit) { return on_pattern(pose, unit)[2]; };
    const Vector normal{component({1, 0, 0}), component({0, 1, 0}), axis[2]};
    result.pose.tilt_y_rad = std::asin(normal[0]);
    result.pose.tilt_x_rad = std::atan2(-normal[1], normal[2]);
    // Direction of the image x axis on the paper, measured at the image centre.
    const Vector right = on_pattern(pose, {1, 0, -normal[0] / normal[2]});
    result.pose.theta_rad = std::atan2(right[1], right[0]);
    return result;
}

std::vector<PenSample> simulate_handwriting(const Handwriting& options) {
    const std::vector<Stroke> strokes = strokes_of(options);
    std::vector<PenSample> samples;
    double begin_s = 0;
    for (std::size_t i = 0; i < strokes.size(); ++i) {
        const Stroke& stroke = strokes[i];
        const Vec2 next = stroke.is_last ? stroke.at(1) : strokes[i + 1].at(0);
        const double end_s = begin_s + stroke.duration_s + stroke.lift_s;
        for (;;) {
            const double t_s = static_cast<double>(samples.size()) / options.rate_hz;
            if (t_s >= end_s) break;
            samples.push_back(sample_at(t_s, begin_s, stroke, next, options.seed));
        }
        begin_s = end_s;
    }
    return samples;
}

}  // namespace dotpose
