// Simulated views from a tilted camera: the frames, the true poses of the camera in space, and the
// Cramer-Rao bounds on the pose errors.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "dotpose/locate.hpp"
#include "dotpose/tools/simulate.hpp"
#include "dotpose/tools/space_pose.hpp"

namespace dotpose::tables {

/// Distance and lens of a simulated camera whose images have 640 x 480 px.
struct SpaceLens {
    const char* title;
    double distance_mm;  ///< distance from the camera to the pose point
    double k;
};
inline constexpr std::array kSpaceLenses = {SpaceLens{"52 degrees", 30, -0.7e-6},
                                            SpaceLens{"28 degrees", 60, -0.2e-6}};

/// Returns frame `index` from a camera that is tilted by `tilt_deg` in a random direction.
Shot space_shot(const SpaceLens& lens, double tilt_deg, std::uint64_t seed, std::uint64_t index);

/// Position in the pattern frame, and rotation from the camera frame to the pattern frame.
struct TrueSpacePose {
    Eigen::Vector3d position_mm;
    Eigen::Matrix3d rotation;
};

/// Returns the true pose of a shot, according to the definitions in simulate.hpp.
TrueSpacePose true_space_pose(const Shot& shot);

/// Returns the parameters of a simulated camera: its true lens distortion and focal length.
Camera space_camera(const CameraModel& model);

using SpaceVector = Eigen::Matrix<double, 6, 1>;
using SpaceMatrix = Eigen::Matrix<double, 6, 6>;

/// Returns the error of a pose, in the coordinates of SpacePose::covariance.
SpaceVector space_error(const CameraInSpace& camera, const TrueSpacePose& truth);

SpaceMatrix matrix_of(const SpaceCovariance& covariance);

/// Returns the squared error of the six coordinates, normalised by the covariance: error^T
/// covariance^-1 error.
double normalised_square(const SpaceVector& error, const SpaceMatrix& covariance);

/// Upper limit for the normalised squared error of a correct pose, over all six coordinates. A
/// correct pose exceeds the limit with a probability of only 2.5e-19.
inline constexpr double kMaxNormalisedSquare = 100;

/// A rendered frame, and the pose in space that dotpose finds in it.
class SpaceReading {
  public:
    explicit SpaceReading(const Shot& shot);

    const Fix& fix() const { return fix_; }
    const std::optional<SpacePose>& pose() const { return pose_; }
#ifdef DOTPOSE_HAS_CALIB3D
    /// Returns the pose that OpenCV computes from the dots that `space_pose` uses. `pose` must have
    /// a value.
    CameraInSpace opencv_pose() const;
#endif

  private:
    Camera camera_;
    GreyImage image_;
    Locator locator_;
    Fix fix_;
    std::optional<SpacePose> pose_;
};

/// Minimum spacing in the image, in px, at which the images of adjacent dots do not overlap. The
/// spacing is measured in the direction in which it is shortest.
inline constexpr double kResolvedSpacing_px = 4;

/// Returns the Cramer-Rao bound on the covariance of a pose. Uses all dots that are completely in
/// view and whose images do not overlap. `jitter_mm` is the standard deviation of the printing
/// errors along each axis. The bound includes image noise but not motion blur.
SpaceMatrix space_bound(const Shot& shot, double jitter_mm);

}  // namespace dotpose::tables
