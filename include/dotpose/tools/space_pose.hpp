/// Pose in space: position and rotation of a camera over the paper (six degrees of freedom). The
/// camera file must contain the focal length.
///
///     use_camera(camera, image.width_px, image.height_px, options);
///     options.show_stages = true;  // space_pose uses the dots in the trace
///     locator.set_options(options);
///     const Fix fix = locator.locate(image);
///     const auto pose = space_pose(fix, camera, image, locator.trace());
///     if (pose && !pose->is_ambiguous()) use(pose->camera.z_mm, lean_of(pose->camera.rotation));
///
/// Coordinate frames, all right-handed:
/// - *camera*: the origin is the projection centre, x is along the image x axis, y is down in the
///   image, and z is forward along the optical axis (the optical frame of ROS REP 103).
/// - *pattern*, *sheet*: x right, y DOWN, z INTO the paper, in mm. A camera above the paper has z <
///   0. Intersection (i, j) of the pattern is at (i, j) times the printed spacing. The origin of
///   the sheet frame is the top left corner of the page.
/// - *world*: the world of a sheet file, in metres, y up, z OUT of the paper. A camera has z > 0.
///
/// The functions are pure and thread-safe.
#pragma once

#include <array>
#include <optional>

#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/print_map.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"
#include "dotpose/trace.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Unit quaternion of a rotation, with w >= 0.
struct Quaternion {
    double w = 1;
    double x = 0;
    double y = 0;
    double z = 0;
};

/// Pose of a camera in the pattern or sheet frame.
struct CameraInSpace {
    double x_mm = 0;  ///< position of the projection centre
    double y_mm = 0;
    double z_mm = 0;      ///< negative above the paper
    Quaternion rotation;  ///< rotates vectors from the camera frame into the frame of the pose
};

/// A rotation as three angles in the pattern or sheet frame: a camera that looks straight at the
/// paper is first rotated by `turn_rad` about its optical axis, and then leans by `tilt_rad` in the
/// direction `azimuth_rad`. W3C Pointer Events use these angles for pens, but specify the altitude
/// (90 degrees minus the tilt) instead of the tilt.
struct CameraLean {
    /// Angle between the optical axis and the normal of the paper, in [0, pi].
    double tilt_rad = 0;
    /// Direction on the paper in which the camera leans, as an angle from +x towards +y, in (-pi,
    /// pi]. Not defined if the tilt is 0.
    double azimuth_rad = 0;
    /// Angle of the image x axis before the camera leans, from +x towards +y, in (-pi, pi]. Equals
    /// `Fix::theta_rad` if the tilt is 0.
    double turn_rad = 0;
};
CameraLean lean_of(const Quaternion& rotation);

/// Covariance of a pose: position, then rotation.
using SpaceCovariance = std::array<std::array<double, 6>, 6>;

/// Second pose that explains the view of a plane: the second local maximum of the likelihood. Its
/// tilt is approximately the tilt of the first pose, mirrored about the line of sight.
struct SecondPose {
    CameraInSpace camera;
    /// log2 of a likelihood ratio: the likelihood of the dots with this pose, divided by their
    /// likelihood with the first pose. The value is at most 0. It is computed under the assumption
    /// that the errors of the dots are independent.
    double odds_log2 = 0;
};

/// Pose of a camera in space, fitted to all dots of a frame.
struct SpacePose {
    CameraInSpace camera;  ///< the pose with the maximum likelihood, in the pattern frame
    /// Covariance of the position in the pattern frame, in mm, and of a small rotation vector in
    /// the CAMERA frame, in radians: true rotation = `rotation` * exp(rotation vector). Computed
    /// from the residuals of the dots. The camera file and the print scale are assumed to be exact.
    SpaceCovariance covariance{};
    int dots = 0;            ///< number of dots used
    double residual_px = 0;  ///< rms residual of these dots, per axis
    /// The second pose that explains the view, if there is one. It may be improbable.
    std::optional<SecondPose> second;

    /// Maximum `SecondPose::odds_log2` at which the dots rule out the second pose. The value is low
    /// because the errors of dots on bent paper are not independent.
    static constexpr double kMaxOdds_log2 = -30;
    /// Returns true if the dots do not rule out the second pose.
    bool is_ambiguous() const { return second && second->odds_log2 > kMaxOdds_log2; }
};

/// Throws BadArgument if `camera` has neither a focal length nor a pinhole model (see
/// `pinhole_of`).
void require_focal_length(const Camera& camera);

/// Fits the position and rotation of `camera` to all dots in `image` by maximum likelihood. First,
/// a preliminary pose is fitted to the dots in `trace`. The preliminary pose predicts the positions
/// of all dots in view, including dots at the image border and far from a tilted camera. These dots
/// are measured again for the final pose.
///
/// The error of a dot has two parts: the printing error, which is foreshortened in a tilted view,
/// and the measurement error of the dot centre in the image. The variances of both parts are
/// estimated from the residuals. Dots with residuals above four standard deviations are not used.
///
/// `print` is the print scale of the sheet. `map` is the map of the page, or null. With a map, the
/// mapped positions of the dots replace their nominal positions, and dots that were not measured
/// for the map are ignored. Check the map with `with_print_map` first, because this function does
/// not detect a map of a different print.
///
/// Returns nullopt if there is no fix, if the spacing is unknown (`Fix::spacing_nm` is 0), or if
/// there are fewer than 12 dots. Throws BadArgument if `camera` has neither a focal length nor a
/// pinhole model.
std::optional<SpacePose> space_pose(const Fix& fix, const Camera& camera, const ImageView& image,
                                    const Trace& trace, const AxisScale& print = {},
                                    const MapPage* map = nullptr);

/// Converts a pose from the pattern frame to the frame of a sheet. The rotation and its covariance
/// are the same in both frames.
CameraInSpace on_sheet(const CameraInSpace& camera, const SheetEntry& entry);

/// Pose of a camera in the world of a sheet file.
struct CameraInWorld {
    double x_m = 0;
    double y_m = 0;
    double z_m = 0;
    Quaternion rotation;  ///< rotates vectors from the camera frame into the world frame
    /// Covariance of the position, in metres, and of a small rotation vector in the WORLD frame, in
    /// radians: true rotation = exp(rotation vector) * `rotation`, as in the ROS message
    /// geometry_msgs/PoseWithCovariance. The pose of the page is assumed to be exact.
    SpaceCovariance covariance{};
};

/// Converts a pose from the sheet frame to the world frame. `covariance` is defined as in
/// SpacePose. `page` is the world pose of the page. If the page is at (0, 0) with yaw 0, the result
/// is the pose in the sheet frame, but in metres, with y up and z out of the paper.
CameraInWorld in_world(const CameraInSpace& camera, const SpaceCovariance& covariance,
                       const WorldPose& page);

/// Converts the pose of a camera to the world frame, using the world pose of the sheet that
/// contains `place`. Returns nullopt if there is no pose or no place, if the dots do not rule out
/// the second pose, or if the sheet has no world pose.
std::optional<CameraInWorld> certain_in_world(const std::optional<SpacePose>& pose,
                                              const std::optional<SheetPlace>& place);

}  // namespace dotpose

DOTPOSE_END_EXPORT
