#include "log_updates.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/core.h>

#include "dotpose/files/error.hpp"

namespace dotpose::cli {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

/// Column names of a pose and its covariance. `units` contains the factors that convert x, y and
/// the angle to metres and radians with y up. The factors for y and the angle are negative if y
/// points down in the log.
struct PoseColumns {
    const char* x;
    const char* y;
    const char* angle;
    const char* covariance;
    std::array<double, 3> units;
};

constexpr PoseColumns kInWorld = {"x_m", "y_m", "yaw_rad", "covariance_m_rad", {1, 1, 1}};
constexpr PoseColumns kInPattern = {
    "x_mm", "y_mm", "theta_deg", "covariance_mm_deg", {1e-3, -1e-3, -kRadians}};

PoseColumns track_columns(bool is_in_world) {
    const double up = is_in_world ? 1 : -1;
    return {"track_x_mm",
            "track_y_mm",
            "track_theta_deg",
            "track_covariance_mm_deg",
            {1e-3, up * 1e-3, up * kRadians}};
}

std::optional<ros::PlanarPose> pose_in(const LogCells& row, const PoseColumns& columns) {
    const auto x = row.number(columns.x);
    const auto y = row.number(columns.y);
    const auto angle = row.number(columns.angle);
    if (!x || !y || !angle) return std::nullopt;
    return ros::PlanarPose{*x * columns.units[0], *y * columns.units[1], *angle * columns.units[2]};
}

std::optional<ros::PlanarCovariance> covariance_in(const LogCells& row,
                                                   const PoseColumns& columns) {
    ros::PlanarCovariance covariance{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const auto value = row.number(fmt::format("{}_{}{}", columns.covariance, i, j));
            if (!value) return std::nullopt;
            covariance[i][j] = *value * columns.units[i] * columns.units[j];
        }
    }
    return covariance;
}

/// Returns the pose and the velocities in a row. The log contains only one standard deviation for
/// the velocity, so it is used for both components.
ros::PlanarMotion motion_in(const LogCells& row, const ros::PlanarPose& pose,
                            const PoseColumns& columns) {
    const auto value = [&row](const char* column) { return row.number(column).value_or(0); };
    ros::PlanarMotion motion;
    motion.pose = pose;
    motion.vx_m_s = value("vx_mm_s") * columns.units[0];
    motion.vy_m_s = value("vy_mm_s") * columns.units[1];
    motion.turn_rad_s = value("turn_deg_s") * columns.units[2];
    const auto covariance = covariance_in(row, columns);
    const auto square_or_unknown = [&row](const char* column, double unit) {
        const auto sigma = row.number(column);
        return sigma ? *sigma * unit * *sigma * unit : ros::kUnobserved;
    };
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const double unknown = i == j ? ros::kUnobserved : 0;
            motion.covariance[i][j] = covariance ? (*covariance)[i][j] : unknown;
        }
        motion.covariance[3 + i][3 + i] = i < 2 ? square_or_unknown("sigma_v_mm_s", 1e-3)
                                                : square_or_unknown("sigma_turn_deg_s", kRadians);
    }
    return motion;
}

/// Column names of a camera pose in space, without their prefix.
struct SpaceColumns {
    std::string_view unit;  ///< unit of x, y and z, which is the suffix of their column names
    std::string_view rotation;
    std::string_view covariance;
    double angle_rad;  ///< size of the angle unit of the covariance, in radians
};

constexpr SpaceColumns kSpaceInWorld = {"m", "quaternion_world_xyzw", "covariance_m_rad", 1};
constexpr SpaceColumns kSpaceInPattern = {"mm", "quaternion_xyzw", "covariance_mm_deg", kRadians};

/// Reads a camera pose in space from the columns whose names begin with `prefix`. The pose is in
/// the world or, if `is_in_world` is false, in the pattern frame with y up. Returns nullopt if the
/// row does not contain the pose.
std::optional<CameraInWorld> space_pose_in(const LogCells& row, const std::string& prefix,
                                           bool is_in_world) {
    const SpaceColumns& columns = is_in_world ? kSpaceInWorld : kSpaceInPattern;
    if (row.text(fmt::format("{}x_{}", prefix, columns.unit)).empty()) return std::nullopt;
    const auto position = [&](char axis) {
        return row.required(fmt::format("{}{}_{}", prefix, axis, columns.unit));
    };
    const auto component = [&](char axis) {
        return row.required(fmt::format("{}{}_{}", prefix, columns.rotation, axis));
    };
    const Quaternion rotation = {component('w'), component('x'), component('y'), component('z')};
    SpaceCovariance covariance{};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
            const double unit = (i < 3 ? 1 : columns.angle_rad) * (j < 3 ? 1 : columns.angle_rad);
            covariance[i][j] =
                unit * row.required(fmt::format("{}{}_{}{}", prefix, columns.covariance, i, j));
        }
    }
    if (is_in_world)
        return CameraInWorld{position('x'), position('y'), position('z'), rotation, covariance};
    return in_world({position('x'), position('y'), position('z'), rotation}, covariance,
                    WorldPose{});
}

/// Returns the camera pose in space that was computed from this frame only, without the track.
/// Returns nullopt if the pose is unknown or ambiguous.
std::optional<CameraInWorld> camera_in(const LogCells& row, bool is_in_world) {
    if (row.text("camera_is_ambiguous") != "false") return std::nullopt;
    return space_pose_in(row, "camera_", is_in_world);
}

/// Returns the motion of the tracked camera. The log contains only one standard deviation for the
/// velocity and one for the angular velocity, so each of them is used for all three components.
std::optional<CameraMotion> camera_motion_in(const LogCells& row, bool is_in_world) {
    const auto pose = space_pose_in(row, "camera_track_", is_in_world);
    if (!pose) return std::nullopt;
    const double up = is_in_world ? 1 : -1;
    const double sigma_m_s = row.required("camera_sigma_v_mm_s") / 1000;
    const double sigma_rad_s = row.required("camera_sigma_turn_deg_s") * kRadians;
    CameraMotion motion;
    motion.pose = *pose;
    for (std::size_t i = 0; i < 3; ++i) {
        const char axis = "xyz"[i];
        motion.velocity_m_s[i] =
            (i == 0 ? 1 : up) * row.required(fmt::format("camera_v{}_mm_s", axis)) / 1000;
        motion.turn_rad_s[i] = row.required(fmt::format("camera_turn_deg_s_{}", axis)) * kRadians;
        motion.velocity_covariance[i][i] = sigma_m_s * sigma_m_s;
        motion.velocity_covariance[3 + i][3 + i] = sigma_rad_s * sigma_rad_s;
    }
    return motion;
}

std::int64_t time_ns_in(const LogCells& row) {
    const double t_s = row.required("t_s");
    if (!(t_s >= 0 && t_s <= double{std::numeric_limits<std::int32_t>::max()})) {
        throw Error(fmt::format("t_s {} is no time of a message, which is 0 to 2^31 - 1", t_s));
    }
    // The log contains times in seconds with six decimals. Rounding recovers the exact number of
    // microseconds.
    return std::llround(t_s * 1e6) * 1000;
}

bool has_event(const LogCells& row, std::string_view event) {
    return row.text("events").find(event) != std::string_view::npos;
}

}  // namespace

ros::RobotUpdate update_of(const LogCells& row) {
    const std::string_view plane = row.text("plane");
    ros::RobotUpdate update;
    update.time_ns = time_ns_in(row);
    // The `plane` column is empty while the robot is lost. In this case, a value in the `x_m`
    // column indicates that the fix is on a sheet with a world pose.
    const bool is_in_world = plane == "world" || (plane.empty() && row.number("x_m"));
    const PoseColumns& columns = is_in_world ? kInWorld : kInPattern;
    if (row.text("status") == "ok") {
        if (const auto pose = pose_in(row, columns)) {
            update.fix = ros::PlanarFix{*pose, covariance_in(row, columns)};
        }
    } else {
        update.problem = row.text("status");
    }
    update.camera = camera_in(row, is_in_world);
    update.camera_motion = camera_motion_in(row, is_in_world);
    update.state = row.text("state");
    if (update.state != "lost") {
        const PoseColumns track = track_columns(is_in_world);
        if (const auto pose = pose_in(row, track)) update.motion = motion_in(row, *pose, track);
    }
    update.is_found_again = has_event(row, "fix") || has_event(row, "kidnapped");
    for (const char* fact :
         {"status", "events", "verdict", "dots_seen", "dots_used", "attempt", "p_wrong", "sheet",
          "camera_is_ambiguous", "camera_second_odds", "camera_verdict"}) {
        const std::string_view text = row.text(fact);
        if (!text.empty() || std::string_view(fact) == "events") {
            update.facts.push_back({fact, std::string(text)});
        }
    }
    return update;
}

}  // namespace dotpose::cli
