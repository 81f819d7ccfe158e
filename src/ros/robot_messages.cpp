#include "dotpose/tools/robot_messages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dotpose/files/error.hpp"
#include "ros/planar.hpp"

namespace dotpose::ros {
namespace {

constexpr std::size_t kSize = 6;  ///< number of rows and columns of the covariances in messages

/// Indices of x, y and yaw in (x, y, z, roll, pitch, yaw).
constexpr std::array<std::size_t, 3> kPlanar = {0, 1, 5};

Quaternion rotation_about_z(double yaw_rad) {
    return {0, 0, std::sin(yaw_rad / 2), std::cos(yaw_rad / 2)};
}

Covariance36 covariance_of(const std::optional<PlanarCovariance>& planar) {
    Covariance36 result{};
    for (std::size_t i = 0; i < kSize; ++i)
        result[i * kSize + i] = kUnobserved;
    if (!planar) return result;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result[kPlanar[i] * kSize + kPlanar[j]] = (*planar)[i][j];
    }
    return result;
}

Pose pose_of(const PlanarPose& planar) {
    return {{planar.x_m, planar.y_m, 0}, rotation_about_z(planar.yaw_rad)};
}

TransformStamped transform_of(const Header& header, std::string child, const PlanarPose& planar) {
    return {
        header, std::move(child), {{planar.x_m, planar.y_m, 0}, rotation_about_z(planar.yaw_rad)}};
}

/// Returns the pose of a camera. The covariance needs no conversion, because it already refers to
/// rotations about the axes of `map`, as the message requires.
PoseWithCovariance pose_of(const CameraInWorld& camera) {
    const dotpose::Quaternion& q = camera.rotation;
    PoseWithCovariance result;
    result.pose = {{camera.x_m, camera.y_m, camera.z_m}, {q.x, q.y, q.z, q.w}};
    for (std::size_t i = 0; i < kSize; ++i) {
        for (std::size_t j = 0; j < kSize; ++j)
            result.covariance[i * kSize + j] = camera.covariance[i][j];
    }
    return result;
}

/// Returns the rotation matrix of a unit quaternion.
std::array<std::array<double, 3>, 3> matrix_of(const dotpose::Quaternion& q) {
    return {{{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.w * q.z),
              2 * (q.x * q.z + q.w * q.y)},
             {2 * (q.x * q.y + q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z),
              2 * (q.y * q.z - q.w * q.x)},
             {2 * (q.x * q.z - q.w * q.y), 2 * (q.y * q.z + q.w * q.x),
              1 - 2 * (q.x * q.x + q.y * q.y)}}};
}

/// Returns the velocities of the camera in the camera frame.
TwistWithCovariance twist_of(const CameraMotion& motion) {
    const auto rotation = matrix_of(motion.pose.rotation);
    std::array<std::array<double, 6>, 6> by_velocity{};
    std::array<double, 3> linear{};
    for (std::size_t i = 0; i < 3; ++i) {
        by_velocity[3 + i][3 + i] = 1;
        for (std::size_t j = 0; j < 3; ++j) {
            by_velocity[i][j] = rotation[j][i];
            linear[i] += rotation[j][i] * motion.velocity_m_s[j];
        }
    }
    TwistWithCovariance result;
    result.twist.linear = {linear[0], linear[1], linear[2]};
    result.twist.angular = {motion.turn_rad_s[0], motion.turn_rad_s[1], motion.turn_rad_s[2]};
    for (std::size_t i = 0; i < kSize; ++i) {
        for (std::size_t j = 0; j < kSize; ++j) {
            for (std::size_t k = 0; k < kSize; ++k) {
                for (std::size_t l = 0; l < kSize; ++l) {
                    result.covariance[i * kSize + j] +=
                        by_velocity[i][k] * motion.velocity_covariance[k][l] * by_velocity[j][l];
                }
            }
        }
    }
    return result;
}

/// Derivatives of three values with respect to (x, y, yaw, vx, vy, turn).
using Jacobian = std::array<std::array<double, 6>, 3>;

PlanarCovariance propagated(const Jacobian& by, const PlanarMotion& motion) {
    PlanarCovariance result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 6; ++k) {
                for (std::size_t l = 0; l < 6; ++l)
                    result[i][j] += by[i][k] * motion.covariance[k][l] * by[j][l];
            }
        }
    }
    return result;
}

/// Returns the covariance of the pose in a frame that is rotated by `yaw_rad` relative to the frame
/// of `motion`.
PlanarCovariance turned_covariance(const PlanarMotion& motion, double yaw_rad) {
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    return propagated({{{c, s, 0, 0, 0, 0}, {-s, c, 0, 0, 0, 0}, {0, 0, 1, 0, 0, 0}}}, motion);
}

/// Returns the velocities of the robot in the robot frame. Their covariance includes the
/// uncertainty of the yaw, which makes the directions of the velocities uncertain.
TwistWithCovariance twist_of(const PlanarMotion& motion) {
    const double c = std::cos(motion.pose.yaw_rad);
    const double s = std::sin(motion.pose.yaw_rad);
    const double forward_m_s = c * motion.vx_m_s + s * motion.vy_m_s;
    const double left_m_s = -s * motion.vx_m_s + c * motion.vy_m_s;
    const Jacobian by = {{{0, 0, left_m_s, c, s, 0},  //
                          {0, 0, -forward_m_s, -s, c, 0},
                          {0, 0, 0, 0, 0, 1}}};
    return {{{forward_m_s, left_m_s, 0}, {0, 0, motion.turn_rad_s}},
            covariance_of(propagated(by, motion))};
}

}  // namespace

RobotFrames with_prefix(const std::string& prefix, RobotFrames frames) {
    const auto is_bad = [](unsigned char c) { return c <= ' ' || c == 127; };
    if (prefix.starts_with('/') || std::ranges::any_of(prefix, is_bad)) {
        throw BadArgument("the frame prefix '" + prefix +
                          "' begins with a slash or contains a space, which ROS does not allow in "
                          "names of frames: use one such as anna/");
    }
    for (std::string* own : {&frames.odom, &frames.base, &frames.camera})
        own->insert(0, prefix);
    return frames;
}

RobotMessenger::RobotMessenger(std::string robot, RobotFrames frames)
    : robot_(std::move(robot)), frames_(std::move(frames)) {}

RobotMessages RobotMessenger::messages(const RobotUpdate& update) {
    const Time stamp = ros_time(update.time_ns);
    RobotMessages result;
    if (update.fix) {
        result.pose = {{stamp, frames_.map},
                       {pose_of(update.fix->pose), covariance_of(update.fix->covariance)}};
    }
    std::vector<TransformStamped> transforms;
    if (update.motion) {
        follow(update);
        result.odometry = odometry({stamp, frames_.odom}, *update.motion);
        transforms = {transform_of({stamp, frames_.map}, frames_.odom, map_from_odom_),
                      transform_of({stamp, frames_.odom}, frames_.base, odom_from_base_)};
    }
    if (update.camera) {
        const Header header = {stamp, frames_.map};
        result.camera = PoseWithCovarianceStamped{header, pose_of(*update.camera)};
        const Pose& pose = result.camera->pose.pose;
        transforms.push_back({header, frames_.camera, {pose.position, pose.orientation}});
    }
    if (update.camera_motion)
        result.camera_odometry = odometry({stamp, frames_.map}, *update.camera_motion);
    if (!transforms.empty()) result.tf = TFMessage{std::move(transforms)};
    result.status = status({stamp, frames_.base}, update);
    return result;
}

/// Updates `odom_from_base_`. If the robot was found again or is on another plane, updates
/// `map_from_odom_` instead, so that the odometry does not jump.
void RobotMessenger::follow(const RobotUpdate& update) {
    const PlanarPose& map_from_base = update.motion->pose;
    if (update.is_found_again || plane_ != update.plane) {
        map_from_odom_ = compose(map_from_base, inverse(odom_from_base_));
    } else {
        odom_from_base_ = compose(inverse(map_from_odom_), map_from_base);
    }
    plane_ = update.plane;
}

Odometry RobotMessenger::odometry(const Header& header, const PlanarMotion& motion) const {
    return {header,
            frames_.base,
            {pose_of(odom_from_base_),
             covariance_of(turned_covariance(motion, map_from_odom_.yaw_rad))},
            twist_of(motion)};
}

Odometry RobotMessenger::odometry(const Header& header, const CameraMotion& motion) const {
    return {header, frames_.camera, pose_of(motion.pose), twist_of(motion)};
}

DiagnosticArray RobotMessenger::status(const Header& header, const RobotUpdate& update) const {
    constexpr std::uint8_t kOk = 0;
    constexpr std::uint8_t kWarning = 1;
    constexpr std::uint8_t kError = 2;
    DiagnosticStatus status;
    status.level = !update.motion ? kError : update.problem.empty() ? kOk : kWarning;
    status.name = "dotpose: " + robot_;
    status.message = update.state;
    if (!update.problem.empty()) status.message += ": " + update.problem;
    status.hardware_id = robot_;
    status.values = update.facts;
    status.values.insert(status.values.begin(), {"state", update.state});
    return {header, {status}};
}

std::optional<TransformStamped> camera_mount(const Camera& camera, const RobotFrames& frames) {
    if (!camera.paper) return std::nullopt;
    const PixelPoint centre{(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
    const CameraPoint reference = from_image_centre(camera, camera.reference_px.value_or(centre));
    // Pose of the robot relative to the camera, in axes parallel to the image axes but with y up.
    const PlanarPose camera_from_base = {reference.x_mm / 1000, -reference.y_mm / 1000,
                                         -camera.theta_offset_rad};
    const PlanarPose base_from_camera = inverse(camera_from_base);
    const Pinhole pinhole = pinhole_of(camera).value_or(Pinhole{});
    const double height_m = std::sqrt(pinhole.focal_u_px * camera.paper->mm_per_px_x *
                                      pinhole.focal_v_px * camera.paper->mm_per_px_y) /
                            1000;
    const double half_rad = base_from_camera.yaw_rad / 2;
    // Rotation by the yaw about z, then by half a turn about the new x axis, so z points down.
    TransformStamped mount;
    mount.header.frame_id = frames.base;
    mount.child_frame_id = frames.camera;
    mount.transform.translation = {base_from_camera.x_m, base_from_camera.y_m, height_m};
    mount.transform.rotation = {std::cos(half_rad), std::sin(half_rad), 0, 0};
    return mount;
}

}  // namespace dotpose::ros
