// Finds the position and direction of a camera on a robot. A turn on the spot determines the
// position, and a straight drive determines the direction.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <Eigen/Core>
#include <fmt/core.h>

#include "calibrate/least_squares.hpp"
#include "calibrate/located_frame.hpp"
#include "calibrate/sheet_spacing.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/mounted_pose.hpp"

namespace dotpose {
namespace {

using calibrate::NormalEquations;
using calibrate::printed_spacing_mm;
using Eigen::Vector2d;

constexpr int kMinSpinFrames = 3;
constexpr double kMinTurn_rad = std::numbers::pi / 6;
constexpr double kMinDrive_mm = 5;
/// Maximum angle by which the robot may turn during a straight drive. This angle also determines
/// how far the robot may be from the line of the drive (see require_straight).
constexpr double kMaxSwerve_rad = std::numbers::pi / 36;
/// Probability of mistaking noise for a drift if the robot does not drift.
constexpr double kFalseDrift = 1e-3;
/// Minimum number of frames required to distinguish a drift from noise.
constexpr int kMinDriftFrames = 5;

/// Position of the image centre in one frame, and angle of the image x axis. The position is in mm
/// relative to the cell of the first fix.
struct Station {
    Vector2d place_mm;
    double theta_rad = 0;
};

/// Stations of all frames with a fix.
struct Stations {
    Camera camera;  ///< the camera without its reference point and angle offset
    std::vector<Station> stations;
    double spacing_mm = 0;
    double mm_per_px = 0;  ///< mean over the frames
};

Vector2d turned(double angle_rad, const Vector2d& v) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

PixelPoint image_centre(const Camera& camera) {
    return {(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
}

Camera without_distortion(const GreyImage& image) {
    Camera camera;
    camera.width_px = image.width_px;
    camera.height_px = image.height_px;
    camera.centre_px = image_centre(camera);
    return camera;
}

/// Throws Error if the mean of `measured_mm` contradicts the spacing of the sheet. `measured_mm`
/// contains the spacings computed from the fixes and the camera file.
void require_spacing(const std::vector<double>& measured_mm, double spacing_mm) {
    double mean_mm = 0;
    for (const double mm : measured_mm)
        mean_mm += mm / static_cast<double>(measured_mm.size());
    if (!contradicts(mean_mm, spacing_mm)) return;
    throw Error(fmt::format(
        "the camera file measures a spacing of {:.3f} mm, but the spacing of the sheet is {:g} mm: "
        "give its --spacing or --sheets, or calibrate the lens again; nothing was written",
        mean_mm, spacing_mm));
}

Stations locate_stations(int frames, const FrameAt& frame_at, const std::optional<Camera>& camera,
                         const CalibrateOptions& options) {
    Stations result;
    Locator locator{DeviceOptions{}};
    CodeReader reader(given_code(options));
    std::vector<Fix> fixes;
    std::vector<Place> places;
    std::vector<double> measured_mm;
    for (int i = 0; i < frames; ++i) {
        const GreyImage image = frame_at(i);
        if (i == 0) result.camera = camera ? *camera : without_distortion(image);
        result.camera.reference_px.reset();
        result.camera.theta_offset_rad = 0;
        DeviceOptions how;
        use_camera(result.camera, image.width_px, image.height_px, how);
        locator.set_options(how);
        const Fix seen = reader.locate(image.view(), locator);
        const Fix fix = with_camera(seen, result.camera, locator.trace());
        if (options.progress && !options.progress(i + 1, frames)) {
            throw Error("stopped; nothing was written");
        }
        if (fix.status != Status::ok) continue;
        fixes.push_back(fix);
        places.push_back({fix.cell, fix.section});
        measured_mm.push_back(measured_spacing_mm(fix, result.camera));
    }
    if (fixes.empty()) return result;
    result.spacing_mm = printed_spacing_mm(options, reader.code(), places);
    require_spacing(measured_mm, result.spacing_mm);
    const Cell first = fixes.front().cell;
    for (const Fix& fix : fixes) {
        result.stations.push_back(
            {result.spacing_mm *
                 Vector2d(calibrate::steps(first.x, fix.cell.x) + fix.fraction_x_q16 / 65536.0,
                          calibrate::steps(first.y, fix.cell.y) + fix.fraction_y_q16 / 65536.0),
             fix.theta_rad()});
        result.mm_per_px +=
            result.spacing_mm / fix.spacing_px() / static_cast<double>(fixes.size());
    }
    return result;
}

/// Returns the length of the smallest arc that contains all angles: a full turn minus the widest
/// gap.
double arc_of(const std::vector<Station>& stations) {
    std::vector<double> angles;
    for (const Station& station : stations)
        angles.push_back(station.theta_rad);
    std::ranges::sort(angles);
    double widest = angles.front() + 2 * std::numbers::pi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i)
        widest = std::max(widest, angles[i] - angles[i - 1]);
    return 2 * std::numbers::pi - widest;
}

/// Returns the undistorted pixel that shows a point. `offset_mm` is relative to the point under the
/// image centre, along the image axes at that point.
PixelPoint pixel_of(const Vector2d& offset_mm, const Stations& stations) {
    if (!stations.camera.paper) {
        const PixelPoint centre = image_centre(stations.camera);
        return {centre.u + offset_mm.x() / stations.mm_per_px,
                centre.v + offset_mm.y() / stations.mm_per_px};
    }
    return pixel_from_image_centre(stations.camera, {offset_mm.x(), offset_mm.y()});
}

/// Returns the standard deviation, per axis, of a point's position due to errors in the lens
/// calibration: the errors of the position of the image centre and of the direction of the image x
/// axis. `offset_mm` is relative to the image centre.
double sigma_of_lens_mm(const Camera& camera, const Vector2d& offset_mm) {
    const auto sigma = [&](const char* key) {
        const auto found = camera.sigma.find(key);
        return found == camera.sigma.end() ? 0 : found->second;
    };
    return std::hypot(sigma("image_centre_mm"),
                      offset_mm.norm() * sigma("image_axis_rad") / std::numbers::sqrt2);
}

void require_stations(std::size_t found, int least, int frames) {
    if (found >= static_cast<std::size_t>(least)) return;
    throw Error(fmt::format("only {} of {} frames could be located; at least {} are needed", found,
                            frames, least));
}

/// Least-squares fit of a turn about one point: pivot + t drift - turn(theta) offset = place. The
/// equation is linear in pivot, drift and offset. t increases from -1 at the first frame to 1 at
/// the last frame.
struct SpotTurn {
    Vector2d pivot;
    Vector2d offset;         ///< from the image centre to the pivot, along the image axes
    Vector2d drift;          ///< 0 if the pivot does not move
    double squares_mm2 = 0;  ///< sum of the squared residuals
    /// Variance of the offset, per axis, relative to the variance of a measured position.
    double offset_fraction = 0;
};

/// Returns the time t of a frame, from -1 to 1.
double time_of(std::size_t frame, const std::vector<Station>& stations) {
    return 2.0 * double(frame) / double(stations.size() - 1) - 1;
}

/// Returns the position predicted by the turn for a frame, minus the measured position.
Vector2d residual_mm(const SpotTurn& spot_turn, std::size_t frame,
                     const std::vector<Station>& stations) {
    const Station& station = stations[frame];
    return spot_turn.pivot + time_of(frame, stations) * spot_turn.drift -
           turned(station.theta_rad, spot_turn.offset) - station.place_mm;
}

/// Fits the rotation of a robot that turns on the spot. If `has_drift` is true, also fits a drift.
SpotTurn fit_turn(const std::vector<Station>& stations, bool has_drift) {
    const std::size_t parameters = has_drift ? 6 : 4;  // pivot, offset, drift
    NormalEquations equations(static_cast<int>(parameters));
    for (std::size_t i = 0; i < stations.size(); ++i) {
        const double c = std::cos(stations[i].theta_rad);
        const double s = std::sin(stations[i].theta_rad);
        const double t = time_of(i, stations);
        const std::array x{1.0, 0.0, -c, s, t, 0.0};
        const std::array y{0.0, 1.0, -s, -c, 0.0, t};
        equations.add(std::span(x).first(parameters), stations[i].place_mm.x());
        equations.add(std::span(y).first(parameters), stations[i].place_mm.y());
    }
    const std::vector<double> solved = equations.solution();
    SpotTurn result{{solved[0], solved[1]}, {solved[2], solved[3]}, {0, 0}};
    if (has_drift) result.drift = {solved[4], solved[5]};
    for (std::size_t i = 0; i < stations.size(); ++i)
        result.squares_mm2 += residual_mm(result, i, stations).squaredNorm();
    result.offset_fraction = equations.unit_covariance()(2, 2);
    return result;
}

/// Returns the error of the offset, per axis, caused by a drift of the robot. Returns 0 if an F
/// test shows that noise can explain the drift. Because the drift has two parameters, the test has
/// 2 and m = 2 n - 6 degrees of freedom, and its p-value is (squares with drift / squares without
/// drift) ^ (m / 2).
double bias_of_drift_mm(const std::vector<Station>& stations, const SpotTurn& on_the_spot) {
    if (stations.size() < kMinDriftFrames) return 0;
    const SpotTurn drifting = fit_turn(stations, true);
    const auto half_m = static_cast<double>(stations.size() - 3);
    const double chance = std::pow(drifting.squares_mm2 / on_the_spot.squares_mm2, half_m);
    if (!(chance < kFalseDrift)) return 0;
    return (drifting.offset - on_the_spot.offset).norm() / std::numbers::sqrt2;
}

/// Throws Error if the centre of rotation is not accurate enough:
/// - The residual is above one spacing, so the robot did not turn on the spot.
/// - The uncertainty is above half a spacing, so the cell under the centre is uncertain.
void require_spin(const SpinCalibration& spin, double spacing_mm) {
    if (spin.residual_mm > spacing_mm) {
        throw Error(
            fmt::format("the frames do not show a turn on the spot: the centre of rotation moved "
                        "by {:.2f} mm from frame to frame (rms per axis), and at most one spacing, "
                        "{:.3f} mm, is permitted; nothing was written",
                        spin.residual_mm, spacing_mm));
    }
    if (spin.sigma_mm <= spacing_mm / 2) return;
    const std::string why = spin.drift_mm > 0
                                ? "the robot moved on while it turned: turn it on the spot"
                                : "turn farther, preferably a full turn, and take more frames";
    throw Error(
        fmt::format("the frames do not determine the centre of rotation: it is known to +- {:.2f} "
                    "mm, and half a spacing, {:.3f} mm, is needed; {}",
                    spin.sigma_mm, spacing_mm / 2, why));
}

/// Returns the direction of the best-fitting line through the positions. This is the major axis of
/// their scatter, pointing forwards along `drive`.
Vector2d direction_of_line(const std::vector<Station>& stations, const Vector2d& mean,
                           const Vector2d& drive) {
    double difference = 0;  // scatter along x minus scatter along y
    double product = 0;
    for (const Station& station : stations) {
        const Vector2d off = station.place_mm - mean;
        difference += off.x() * off.x() - off.y() * off.y();
        product += off.x() * off.y();
    }
    const double angle_rad = std::atan2(2 * product, difference) / 2;
    const Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
    return along.dot(drive) < 0 ? Vector2d(-along) : along;
}

/// Throws Error if a position is too far from the line or too far behind an earlier position. Both
/// limits are equal to the distance from the line that a robot reaches if it turns by
/// kMaxSwerve_rad in the middle of the drive.
void require_straight(const std::vector<Vector2d>& on_line, double length_mm) {
    const double max_mm = std::tan(kMaxSwerve_rad) * length_mm / 2;
    double farthest_mm = on_line.front().x();
    for (const Vector2d& place : on_line) {
        if (std::abs(place.y()) > max_mm) {
            throw Error(fmt::format(
                "the robot did not drive straight: it was {:.2f} mm off the line, which is more "
                "than {:.0f} degrees as seen from the middle; drive straight ahead",
                std::abs(place.y()), kMaxSwerve_rad * 180 / std::numbers::pi));
        }
        farthest_mm = std::max(farthest_mm, place.x());
        if (farthest_mm - place.x() > max_mm) {
            throw Error(
                fmt::format("the robot went back by {:.2f} mm: drive straight ahead, and "
                            "name the frames in order",
                            farthest_mm - place.x()));
        }
    }
}

}  // namespace

const char* name(MountVerdict verdict) {
    return verdict == MountVerdict::good ? "good" : "drifted";
}

SpinCalibration calibrate_spin(int frames, const FrameAt& frame_at,
                               const std::optional<Camera>& camera,
                               const CalibrateOptions& options) {
    const Stations found = locate_stations(frames, frame_at, camera, options);
    require_stations(found.stations.size(), kMinSpinFrames, frames);
    SpinCalibration result;
    result.frames = frames;
    result.located = static_cast<int>(found.stations.size());
    result.turn_rad = arc_of(found.stations);
    if (result.turn_rad < kMinTurn_rad) {
        throw Error(fmt::format(
            "the frames cover {:.0f} degrees of a turn: turn the robot on the spot by at least "
            "{:.0f} degrees, preferably a full turn",
            result.turn_rad * 180 / std::numbers::pi, kMinTurn_rad * 180 / std::numbers::pi));
    }
    const SpotTurn fitted = fit_turn(found.stations, false);
    const Vector2d& offset = fitted.offset;
    for (const Station& station : found.stations) {
        const Vector2d from_pivot = station.place_mm - fitted.pivot;
        const Vector2d off = from_pivot + turned(station.theta_rad, offset);
        result.stations.push_back(
            {from_pivot.x(), from_pivot.y(), station.theta_rad, off.x(), off.y()});
    }
    const int freedom = 2 * result.located - 4;
    result.residual_mm = std::sqrt(fitted.squares_mm2 / freedom);
    result.drift_mm = bias_of_drift_mm(found.stations, fitted);
    result.verdict = result.drift_mm > 0 ? MountVerdict::drifted : MountVerdict::good;
    result.camera = camera.value_or(found.camera);
    result.sigma_mm = std::hypot(result.residual_mm * std::sqrt(fitted.offset_fraction),
                                 result.drift_mm, sigma_of_lens_mm(result.camera, offset));
    require_spin(result, found.spacing_mm);
    result.camera.reference_px = pixel_of(offset, found);
    result.offset_mm = {offset.x(), offset.y()};
    result.camera.sigma["reference_u_px"] = result.sigma_mm / found.mm_per_px;
    result.camera.sigma["reference_v_px"] = result.sigma_mm / found.mm_per_px;
    try {
        validate(result.camera);
    } catch (const BadArgument& error) {
        throw Error(fmt::format("the robot did not turn about one point ({})", error.what()));
    }
    return result;
}

DriveCalibration calibrate_drive(int frames, const FrameAt& frame_at,
                                 const std::optional<Camera>& camera,
                                 const CalibrateOptions& options) {
    const Stations found = locate_stations(frames, frame_at, camera, options);
    require_stations(found.stations.size(), 2, frames);
    DriveCalibration result;
    result.frames = frames;
    result.located = static_cast<int>(found.stations.size());
    const auto count = static_cast<double>(found.stations.size());
    Vector2d mean = Vector2d::Zero();
    Vector2d heading = Vector2d::Zero();
    for (const Station& station : found.stations) {
        mean += station.place_mm / count;
        heading += Vector2d(std::cos(station.theta_rad), std::sin(station.theta_rad));
    }
    const Vector2d drive = found.stations.back().place_mm - found.stations.front().place_mm;
    result.length_mm = drive.norm();
    if (result.length_mm < kMinDrive_mm) {
        throw Error(
            fmt::format("the robot moved by only {:.1f} mm: drive straight ahead for some "
                        "centimetres, and name the frames in order",
                        result.length_mm));
    }
    const Vector2d along = direction_of_line(found.stations, mean, drive);
    std::vector<Vector2d> on_line;
    double along_mm2 = 0;
    double across_mm2 = 0;
    for (const Station& station : found.stations) {
        const Vector2d off = station.place_mm - mean;
        on_line.push_back({along.dot(off), along.x() * off.y() - along.y() * off.x()});
        along_mm2 += on_line.back().x() * on_line.back().x();
        across_mm2 += on_line.back().y() * on_line.back().y();
    }
    require_straight(on_line, result.length_mm);
    const double theta_rad = std::atan2(heading.y(), heading.x());
    result.residual_mm = std::sqrt(across_mm2 / count);
    // The variance of the result is the variance of the line's direction plus the variance of the
    // mean angle.
    const double line = result.residual_mm * result.residual_mm / along_mm2;
    double squares = 0;
    double swerve_rad = 0;
    for (const Station& station : found.stations) {
        const double off = std::remainder(station.theta_rad - theta_rad, 2 * std::numbers::pi);
        squares += off * off;
        swerve_rad = std::max(swerve_rad, std::abs(off));
    }
    if (swerve_rad > kMaxSwerve_rad) {
        throw Error(fmt::format(
            "the robot turned by {:.0f} degrees from its mean direction: drive straight ahead",
            swerve_rad * 180 / std::numbers::pi));
    }
    result.sigma_rad = std::sqrt(line + squares / (count * std::max(count - 1, 1.0)));
    result.camera = camera.value_or(found.camera);
    result.camera.theta_offset_rad =
        std::remainder(std::atan2(along.y(), along.x()) - theta_rad, 2 * std::numbers::pi);
    result.camera.sigma["theta_offset_rad"] = result.sigma_rad;
    return result;
}

}  // namespace dotpose
