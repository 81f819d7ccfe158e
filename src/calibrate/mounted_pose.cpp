// Fits the pose (position, angle and scale) of a camera with a known view of the paper, by least
// squares.
#include "dotpose/tools/mounted_pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "calibrate/dot_fit.hpp"
#include "calibrate/least_squares.hpp"
#include "calibrate/mapped_dots.hpp"
#include "dotpose/tools/print_mapping.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate;

constexpr std::size_t kMinPoseDots = 12;

/// Numbers of parameters in the equation for a dot: without motion, with motion, and with both
/// motion and turn of the camera. The equation is
///
///   printed + displacement * displaced = place + (c, -s; s, c) (x, y) + t v
///
/// (x, y) is the position of the dot in mm from `middle`. All other lengths are in spacings,
/// corrected for the print scale. The parameters are place, c, s and the displacement, which is
/// fitted because ink and blur change it.
///
/// For a rolling shutter, the parameters also include the motion v and the turn of the camera
/// during the readout. t is the time at which the row of the dot is read, as a fraction of the
/// readout time, from -1/2 to 1/2. At this time, (x, y) is rotated about the reference point by t
/// times the turn. The reference point moves along an arc, so t v is replaced by the chord of this
/// arc.
constexpr int kParameters = 5;
constexpr int kMovingParameters = 7;
constexpr int kTurningParameters = 8;

struct PoseFit : DotFit {
    CameraPoint middle;
    double turn_rad = 0;  ///< turn of the camera during the readout
};

/// Returns the vector from `from` to `to`, rotated by an angle.
CameraPoint turned(CameraPoint from, CameraPoint to, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    const double x = to.x_mm - from.x_mm;
    const double y = to.y_mm - from.y_mm;
    return {c * x - s * y, s * x + c * y};
}

/// Fits the pose to the dots at their mapped positions. `reference` is the reference point. For a
/// rolling shutter, the equation is linearised at `turn_rad`, and the fit is repeated with the turn
/// found by the previous fit.
PoseFit fit_pose(const std::vector<MappedDot>& dots, const Camera& camera, const AxisScale& print,
                 CameraPoint reference, double turn_rad) {
    std::vector<CameraPoint> points;
    CameraPoint middle;
    for (const auto& [dot, offset] : dots) {
        points.push_back(on_paper(camera, dot.pixel));
        middle.x_mm += points.back().x_mm / static_cast<double>(dots.size());
        middle.y_mm += points.back().y_mm / static_cast<double>(dots.size());
    }
    const auto fit_near = [&](const PoseFit& last, int parameters) {
        const double turn = last.turn_rad;
        const auto& p = last.parameters;
        const CameraPoint motion =
            p.empty() ? CameraPoint{} : CameraPoint{p[kParameters], p[kParameters + 1]};
        std::vector<DotEquation> equations;
        for (std::size_t i = 0; i < dots.size(); ++i) {
            double x = points[i].x_mm - middle.x_mm;
            double y = points[i].y_mm - middle.y_mm;
            const auto& [dot, offset] = dots[i];
            const double t =
                (distorted(camera, dot.pixel).v - (camera.height_px - 1) / 2.0) / camera.height_px;
            const CameraPoint arm = turned(reference, points[i], t * turn);
            if (turn != 0) {
                x = arm.x_mm + reference.x_mm - middle.x_mm;
                y = arm.y_mm + reference.y_mm - middle.y_mm;
            }
            const double half = t * turn / 2;
            const double way = half == 0 ? t : t * std::sin(half) / half;
            const double way_x = way * std::cos(half);
            const double way_y = way * std::sin(half);
            // Derivative of the dot's position with respect to the turn.
            double turn_x = 0;
            double turn_y = 0;
            if (!p.empty()) {
                turn_x = t * (-p[2] * arm.y_mm - p[3] * arm.x_mm) - t * t / 2 * motion.y_mm;
                turn_y = t * (-p[3] * arm.y_mm + p[2] * arm.x_mm) + t * t / 2 * motion.x_mm;
            }
            equations.push_back(
                {AxisEquation{{1, 0, x, -y, -print.x * dx(dot.symbol), way_x, -way_y, turn_x},
                              print.x * (dot.step.x + offset.x())},
                 AxisEquation{{0, 1, y, x, -print.y * dy(dot.symbol), way_y, way_x, turn_y},
                              print.y * (dot.step.y + offset.y())}});
        }
        return fit_dots(equations, parameters);
    };
    PoseFit fit{{}, middle, camera.readout_ms ? turn_rad : 0};
    static_cast<DotFit&>(fit) = fit_near(fit, camera.readout_ms ? kMovingParameters : kParameters);
    constexpr int kRounds = 4;
    for (int round = 0; camera.readout_ms && round < kRounds; ++round) {
        static_cast<DotFit&>(fit) = fit_near(fit, kTurningParameters);
        fit.turn_rad += fit.parameters[kMovingParameters];
    }
    return fit;
}

/// Returns the dots with all offsets set to 0.
std::vector<MappedDot> without_map(std::vector<MappedDot> dots) {
    for (MappedDot& dot : dots)
        dot.offset.setZero();
    return dots;
}

/// Fits the pose to all dots of a frame or, if the map belongs to this print, to the mapped dots.
/// Sets `use`.
PoseFit fit_mapped_pose(const Fix& fix, const Camera& camera, const Trace& trace,
                        const AxisScale& print, const PrintMap& map, CameraPoint reference,
                        MapUse& use) {
    const MappedDots mapped = mapped_dots(fix, map, trace);
    use = mapped.use;
    if (use == MapUse::used) {
        const auto fit = [&](const std::vector<MappedDot>& dots) {
            return fit_pose(dots, camera, print, reference, fix.readout_turn_rad);
        };
        PoseFit with_map = fit(mapped.dots);
        if (is_same_print(with_map.variance, fit(without_map(mapped.dots)).variance, mapped.noise))
            return with_map;
        use = MapUse::contradicted;
    }
    std::vector<MappedDot> dots;
    for (const LocatedDot& dot : dots_read(trace))
        dots.push_back({dot});
    return fit_pose(dots, camera, print, reference, fix.readout_turn_rad);
}

std::uint32_t to_bam(double angle_rad) {
    constexpr double kBam_per_rad = 2147483648.0 / std::numbers::pi;
    return static_cast<std::uint32_t>(std::llround(angle_rad * kBam_per_rad));
}

/// Sets the cell, section and fraction of `fix` to the position that is (x, y) spacings from
/// `place`.
void write_place(double x, double y, CodeVariant code, const Place& place, Fix& fix) {
    const auto x_q16 = std::llround(x * 65536);
    const auto y_q16 = std::llround(y * 65536);
    const Place cell = moved(code, place, static_cast<std::int32_t>(x_q16 >> 16),
                             static_cast<std::int32_t>(y_q16 >> 16));
    fix.cell = cell.cell;
    fix.section = cell.section;
    fix.fraction_x_q16 = static_cast<std::uint16_t>(x_q16 & 65535);
    fix.fraction_y_q16 = static_cast<std::uint16_t>(y_q16 & 65535);
}

/// Sets the covariance of `out` to the covariance of the pose at the reference point. (`x`, `y`) is
/// the reference point, in mm from the middle of the dots. The variance of the angle on the paper
/// is also used for the nominal angle, because the two variances are nearly equal.
void write_covariance(const PoseFit& fit, double x, double y, const AxisScale& print, Fix& out) {
    const double c = fit.parameters[2];
    const double s = fit.parameters[3];
    const double size2 = c * c + s * s;
    Eigen::MatrixXd by_parameter = Eigen::MatrixXd::Zero(3, fit.covariance.cols());
    by_parameter.leftCols(4) << 1 / print.x, 0, x / print.x, -y / print.x,  //
        0, 1 / print.y, y / print.y, x / print.y,                           //
        0, 0, -s / size2, c / size2;
    const Eigen::MatrixXd covariance = propagated(by_parameter, fit.covariance);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            out.covariance[i][j] = static_cast<float>(covariance(i, j));
    }
}

/// Returns the velocity during the readout of a rolling shutter, computed from the last three
/// parameters of the fit.
ReadoutVelocity velocity_of(const PoseFit& pose, double readout_ms, const AxisScale& print) {
    constexpr int kFirst = kParameters;
    // Factors that convert the motion during the readout to velocities: the motion along x and y to
    // nominal spacings per second, and the turn to rad per second.
    const std::array per_s{1000 / (readout_ms * print.x), 1000 / (readout_ms * print.y),
                           1000 / readout_ms};
    ReadoutVelocity velocity{per_s[0] * pose.parameters[kFirst],
                             per_s[1] * pose.parameters[kFirst + 1],
                             per_s[2] * pose.turn_rad,
                             {}};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            velocity.covariance[i][j] =
                per_s[i] * per_s[j] * pose.covariance(kFirst + i, kFirst + j);
        }
    }
    return velocity;
}

}  // namespace

double measured_spacing_mm(const Fix& fix, const Camera& camera, const AxisScale& print) {
    if (fix.status != Status::ok || !camera.paper) return std::numeric_limits<double>::quiet_NaN();
    const PixelPoint middle{(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
    const PaperScale& paper = *camera.paper;
    const double divisor = 1 + paper.perspective_u * (middle.u - camera.centre_px.u) +
                           paper.perspective_v * (middle.v - camera.centre_px.v);
    // The Jacobian determinant of a homography is the determinant of its matrix divided by
    // divisor^3.
    const double mm2_per_px2 = paper.mm_per_px_x * paper.mm_per_px_y / std::pow(divisor, 3);
    const FixedVec du = fix.pattern_from_image.du_q24;
    const FixedVec dv = fix.pattern_from_image.dv_q24;
    constexpr double kQ24 = 1 << 24;
    const double cells2_per_px2 =
        std::abs(double(du.x) * dv.y - double(dv.x) * du.y) / (kQ24 * kQ24);
    return std::sqrt(mm2_per_px2 / (cells2_per_px2 * print.x * print.y));
}

bool contradicts(double measured_mm, double spacing_mm) {
    return std::abs(std::log(measured_mm / spacing_mm)) > std::log1p(kMaxSpacingDifference);
}

Fix with_camera(const Fix& fix, const Camera& camera, const Trace& trace, const AxisScale& print) {
    return with_camera_and_velocity(fix, camera, trace, print).fix;
}

MovingFix with_camera_and_velocity(const Fix& fix, const Camera& camera, const Trace& trace,
                                   const AxisScale& print) {
    const MappedMovingFix moving = with_camera_and_map(fix, camera, trace, print, {});
    return {moving.fix, moving.velocity};
}

MappedMovingFix with_camera_and_map(const Fix& seen, const Camera& camera, const Trace& trace,
                                    const AxisScale& print, const PrintMap& map) {
    if (seen.status != Status::ok) return {seen, {}, MapUse::no_map};
    MappedFix mapped{seen};
    // If the camera file contains no view of the paper, fits the plane of the fix to the mapped
    // dots.
    if (!camera.paper) mapped = with_print_map(seen, map, trace);
    const Fix& fix = mapped.fix;
    Fix result = fix;
    std::optional<ReadoutVelocity> velocity;
    // Angle on the paper. It differs slightly from the nominal angle if the print scales of the
    // axes differ.
    double theta_rad =
        std::atan2(std::sin(fix.theta_rad()) * print.y, std::cos(fix.theta_rad()) * print.x);
    if (camera.paper && dots_read(trace).size() >= kMinPoseDots) {
        const PixelPoint reference{
            (camera.width_px - 1) / 2.0 + trace.options.reference_dx_q8 / 256.0,
            (camera.height_px - 1) / 2.0 + trace.options.reference_dy_q8 / 256.0};
        const CameraPoint at = on_paper(camera, reference);
        const PoseFit pose = fit_mapped_pose(fix, camera, trace, print, map, at, mapped.use);
        if (camera.readout_ms) velocity = velocity_of(pose, *camera.readout_ms, print);
        const double x = at.x_mm - pose.middle.x_mm;
        const double y = at.y_mm - pose.middle.y_mm;
        const auto& p = pose.parameters;
        write_place((p[0] + x * p[2] - y * p[3]) / print.x, (p[1] + y * p[2] + x * p[3]) / print.y,
                    trace.options.code, trace.decoding.place, result);
        write_covariance(pose, x, y, print, result);
        if (mapped.use == MapUse::used)
            add_map_error(*find_page(map, trace.options.code, {fix.cell, fix.section}), result);
        result.dots_used = pose.dots;
        result.dots_seen = std::max(result.dots_seen, result.dots_used);
        result.residual_px = static_cast<float>(std::sqrt(pose.variance) * fix.spacing_px());
        // Theta is defined at the image centre, so the direction of the image x axis is computed
        // there. At other pixels, the image rows of a tilted camera have a different direction on
        // the paper.
        const PixelPoint centre{(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
        theta_rad =
            std::atan2(pose.parameters[3], pose.parameters[2]) + image_axis_rad(camera, centre);
    }
    theta_rad += camera.theta_offset_rad;
    result.theta_bam = static_cast<std::int32_t>(
        to_bam(std::atan2(std::sin(theta_rad) / print.y, std::cos(theta_rad) / print.x)));
    return {result, velocity, mapped.use};
}

}  // namespace dotpose
