/// Robot messages: converts the results for an image to ROS 2 messages.
///
///     Follower follower(options);
///     RobotMessenger messenger("anna");
///     const Followed now = follower.follow(image.view(), time_us);
///     const RobotMessages messages =
///         messenger.messages(update_of(now, follower.is_in_world(), time_us * 1000));
///     if (messages.pose) publish(to_cdr(*messages.pose));
///
/// Coordinate frames (ROS REP 103: metres, x forward, y left, z up, counter-clockwise; REP 105):
/// - `map` is the world frame of the sheet file or, without a sheet file, the pattern frame with y
///   up and the same origin.
/// - The origin of `odom` is the first pose of the robot.
/// - The origin of `base_link` is the point on the paper at the reference pixel in the camera file.
///   Its x axis is along the robot's heading. Without a camera file, the origin is the point under
///   the image centre, and the x axis is along the image x axis.
///
/// `camera_optical` is the optical frame of the camera: z is along the optical axis, and x and y
/// are along the axes of the image. By default, its parent is `base_link`, and its pose is constant
/// (see `camera_mount`). If poses in space are fitted (`FollowerOptions::fits_space_pose`), its
/// parent is `map`, and each image gives a new pose. In that case, do not publish the mount,
/// because a coordinate frame can have only one parent.
///
/// While the robot is tracked, the transform from `map` to `odom` is constant. This transform jumps
/// when the robot is found again after being lost or moved by hand, and when the robot enters
/// another plane. The transform from `odom` to `base_link` is always continuous.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/tools/follower.hpp"
#include "dotpose/tools/ros_messages.hpp"
#include "dotpose/tools/space_pose.hpp"
#include "dotpose/tools/space_track.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose::ros {

/// Variance, in m^2 or rad^2, of coordinates that are not observed (height, roll and pitch), and of
/// poses without a known covariance.
inline constexpr double kUnobserved = 1e6;

/// A pose in a plane, y up.
struct PlanarPose {
    double x_m = 0;
    double y_m = 0;
    double yaw_rad = 0;
};

using PlanarCovariance = std::array<std::array<double, 3>, 3>;

/// The pose from a single image.
struct PlanarFix {
    PlanarPose pose;
    std::optional<PlanarCovariance> covariance;  ///< covariance of (x, y, yaw)
};

/// Pose and velocities of a tracked robot.
struct PlanarMotion {
    PlanarPose pose;
    double vx_m_s = 0;  ///< velocity along the x axis of the plane
    double vy_m_s = 0;
    double turn_rad_s = 0;
    /// Covariance of the six values above, in the same order.
    std::array<std::array<double, 6>, 6> covariance{};
};

/// Results for one image, in the `map` coordinate frame.
struct RobotUpdate {
    std::int64_t time_ns = 0;  ///< middle of the exposure
    /// None if there is no fix, or if the place of the fix is unknown.
    std::optional<PlanarFix> fix;
    std::optional<PlanarMotion> motion;  ///< none while the robot is lost
    /// Pose of the camera in space, in `map`. None if poses in space are not fitted, or if the dots
    /// do not rule out the second pose (see SecondPose).
    std::optional<CameraInWorld> camera;
    /// Motion of the tracked camera in `map`. None if poses in space are not fitted, or while the
    /// camera is lost.
    std::optional<CameraMotion> camera_motion;
    /// ID of the plane of the motion (see TrackedPose::plane). Poses in different planes are
    /// unrelated.
    std::uint32_t plane = 0;
    bool is_found_again = false;  ///< true if the motion does not continue the previous motion
    std::string state;            ///< "lost", "moving" or "stationary"
    std::string problem;          ///< reason why there is no fix, or empty
    std::vector<KeyValue> facts;  ///< additional values for the diagnostics of the image
};

/// Returns the results for an image. `is_in_world` is the result of Follower::is_in_world.
RobotUpdate update_of(const Followed& followed, bool is_in_world, std::int64_t time_ns);

/// Names of the coordinate frames.
struct RobotFrames {
    std::string map = "map";
    std::string odom = "odom";
    std::string base = "base_link";
    std::string camera = "camera_optical";
};

/// Returns `frames` with `prefix`, for example "anna/", prepended to `odom`, `base` and `camera`.
/// `map` does not change, so robots with different prefixes can share one transform tree. Throws
/// BadArgument if the prefix is not allowed in ROS, that is, if it begins with a slash or contains
/// spaces or control characters.
RobotFrames with_prefix(const std::string& prefix, RobotFrames frames = {});

/// Messages for one image. `pose` is none if there is no fix. `odometry` is none while the robot is
/// lost.
struct RobotMessages {
    std::optional<PoseWithCovarianceStamped> pose;  ///< pose of the fix, in `map`
    std::optional<Odometry> odometry;  ///< pose of the track in `odom`, twist in `base_link`
    std::optional<PoseWithCovarianceStamped> camera;  ///< pose of the camera in space, in `map`
    /// Pose of the tracked camera in `map`, twist in `camera_optical`. None while the camera is
    /// lost.
    std::optional<Odometry> camera_odometry;
    /// Transforms: `map` to `odom` and `odom` to `base_link` unless the robot is lost, and `map` to
    /// `camera_optical` if the pose in space is known. None if there are no transforms.
    std::optional<TFMessage> tf;
    DiagnosticArray status;
};

/// Creates the messages for one robot, image by image.
class RobotMessenger {
  public:
    explicit RobotMessenger(std::string robot, RobotFrames frames = {});

    RobotMessages messages(const RobotUpdate& update);

    const RobotFrames& frames() const { return frames_; }

  private:
    void follow(const RobotUpdate& update);
    Odometry odometry(const Header& header, const PlanarMotion& motion) const;
    Odometry odometry(const Header& header, const CameraMotion& motion) const;
    DiagnosticArray status(const Header& header, const RobotUpdate& update) const;

    std::string robot_;
    RobotFrames frames_;
    PlanarPose map_from_odom_;
    PlanarPose odom_from_base_;
    std::optional<std::uint32_t> plane_;  ///< none before the first pose
};

/// Returns the mount of the camera: the pose of the optical frame in `base_link`. The origin of the
/// optical frame is above the point under the image centre. z points towards the paper, and x and y
/// are along the axes of the image. The height is 0 if the camera file has no focal length. Returns
/// none if the camera file has no view of the paper.
std::optional<TransformStamped> camera_mount(const Camera& camera, const RobotFrames& frames = {});

}  // namespace dotpose::ros

DOTPOSE_END_EXPORT
