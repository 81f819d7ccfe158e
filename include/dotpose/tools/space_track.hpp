/// Tracks a camera in space: smooths the poses of single frames, predicts the pose at other times,
/// rejects outliers, and resolves ambiguous poses.
///
///     SpaceTracker tracker;
///     for (;;) {
///         const auto pose = space_pose(fix, camera, image, locator.trace());
///         const SpaceTrack& track = pose ? tracker.update(sighting_of(*pose, time_us))
///                                        : tracker.update(time_us);
///     }
///
/// The motion model is that of Tracker (track.hpp): accelerations decay towards zero and are driven
/// by white noise (Singer 1970). The model applies to each axis of the position, and to each axis
/// of the rotation in the camera frame. All poses are in one coordinate frame: the pattern, a
/// sheet, or any other frame in mm.
///
/// Printing errors are equal in all frames that show the same dots. The tracker estimates what
/// fraction of a sighting's covariance is due to errors that are independent between sightings.
/// Only this fraction is reduced by smoothing. The rest is added to the covariance of the track.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "dotpose/export.hpp"
#include "dotpose/tools/space_pose.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Pose of a camera in space, measured in one frame.
struct SpaceSighting {
    std::int64_t time_us = 0;  ///< middle of the exposure, on any clock
    CameraInSpace camera;
    SpaceCovariance covariance{};  ///< as in SpacePose
    std::optional<SecondPose> second;
    /// ID of the coordinate frame. Poses with different IDs are unrelated.
    std::uint32_t plane = 0;
};
SpaceSighting sighting_of(const SpacePose& pose, std::int64_t time_us, std::uint32_t plane = 0);

/// Converts a pose to a sighting in the world, for a camera that moves over several sheets. `place`
/// is the place of the fix on the sheet in view. The sighting is in the world frame rotated by 180
/// degrees about x, in mm, so y is down and z is into the paper, as in the pattern. Returns nullopt
/// if the sheet has no world pose.
std::optional<SpaceSighting> world_sighting(const SpacePose& pose, const SheetPlace& place,
                                            std::int64_t time_us);

/// Assumptions about the motion of the camera, and criteria for accepting sightings.
struct SpaceTrackOptions {
    /// Standard deviation of the acceleration along each axis. The default suits a hand-held
    /// camera.
    double acceleration_mm_s2 = 2000;
    double angular_acceleration_rad_s2 = 20;
    double hold_s = 0.5;  ///< time constant of the decay of accelerations
    /// Standard deviation of the velocity along each axis, and of the angular velocity about each
    /// axis, at the start of a track.
    double speed_mm_s = 500;
    double turn_rad_s = 5;
    /// Maximum normalised innovation squared, with six degrees of freedom, of an accepted sighting.
    /// A correct sighting exceeds the default by chance about once in 2 * 10^7.
    double max_innovation = 45;
    /// Number of consecutive rejected sightings, consistent with each other, after which the track
    /// restarts from the newest of them.
    int confirmations = 3;
    /// Time without an accepted sighting after which the camera is lost.
    std::int64_t lost_after_us = 200'000;
};

/// Verdict of the tracker on the sighting from a frame.
enum class SpaceVerdict : std::uint8_t {
    none,             ///< there was no sighting
    accepted,         ///< the first pose was used
    second_accepted,  ///< the second pose was used, because it agrees better with the track
    /// The sighting was rejected for one of these reasons:
    /// - The track contradicts the sighting.
    /// - The sighting is ambiguous, and the track does not resolve the ambiguity, or there is no
    ///   track.
    rejected,
};
/// Returns the identifier, such as "second_accepted".
const char* name(SpaceVerdict verdict) noexcept;

/// State of a tracked camera.
struct SpaceTrack {
    bool is_lost = true;
    bool is_new = false;  ///< true if the track does not continue the previous track
    SpaceVerdict verdict = SpaceVerdict::none;
    std::int64_t time_us = 0;
    std::uint32_t plane = 0;
    CameraInSpace camera;
    SpaceCovariance covariance{};  ///< as in SpacePose
    std::array<double, 3> velocity_mm_s{};
    std::array<double, 3> turn_rad_s{};     ///< angular velocity about the axes of the camera frame
    SpaceCovariance velocity_covariance{};  ///< covariance of `velocity_mm_s` and `turn_rad_s`
};

/// Motion of a camera in the world of a sheet file.
struct CameraMotion {
    CameraInWorld pose;
    std::array<double, 3> velocity_m_s{};
    std::array<double, 3> turn_rad_s{};     ///< about the axes of the camera frame
    SpaceCovariance velocity_covariance{};  ///< covariance of `velocity_m_s` and `turn_rad_s`
};

/// Converts a track to metres, with y up and z out of the paper. The track is in mm, with y down
/// and z into the paper. The result is in the world frame if the sightings were created by
/// `world_sighting`. If the sightings are in the pattern frame, the result is in the pattern frame
/// with y up. Returns nullopt while the camera is lost.
std::optional<CameraMotion> motion_of(const SpaceTrack& track);

/// Implementation details of SpaceTracker: the filter state. Not part of the public API.
namespace space_track {

inline constexpr std::size_t kStates = 18;

/// Estimated motion. Each row of `covariance` has six elements for position and rotation, six for
/// their velocities, and six for their accelerations. Rotations are about the axes of the camera
/// frame.
struct Motion {
    std::int64_t time_us = 0;
    CameraInSpace camera;
    std::array<double, 6> velocity{};      ///< mm/s, rad/s
    std::array<double, 6> acceleration{};  ///< mm/s^2, rad/s^2
    std::array<double, kStates * kStates> covariance{};
    /// Process noise along each axis: the variance of the acceleration noise, divided by the
    /// variance in the options. The last three axes are the rotation. The first three axes are the
    /// position minus its linear regression on the rotation, which is computed from `noise`.
    std::array<double, 6> agility{1, 1, 1, 1, 1, 1};
    /// Innovation of the latest accepted sighting, along the axes of `agility`.
    std::array<double, 6> innovation{};
    SpaceCovariance noise{};  ///< covariance of the latest accepted sighting
    /// Fraction of `noise` that is independent of the errors of earlier sightings, and the Fisher
    /// information about the logarithm of this fraction.
    double independent = 1;
    double independent_information = 3;
    /// Innovation of the latest accepted sighting, multiplied by the inverse of its covariance.
    std::array<double, 6> weighted_innovation{};
};

}  // namespace space_track

/// Tracks one camera. Different trackers may be used concurrently.
class SpaceTracker {
  public:
    explicit SpaceTracker(const SpaceTrackOptions& options = {}) : options_(options) {}

    /// Processes the sighting of a frame. A sighting starts a new track in these cases:
    /// - The camera is lost, or no sighting was accepted for more than `lost_after_us`.
    /// - The sighting is in a different plane from the track, or not later than the previous frame.
    /// If the sighting is ambiguous in one of these cases, it starts no track, and the camera is
    /// lost.
    const SpaceTrack& update(const SpaceSighting& sighting);
    /// Processes a frame without a sighting. The camera becomes lost if the frame is earlier than
    /// the previous frame, or more than `lost_after_us` later than the last accepted sighting.
    const SpaceTrack& update(std::int64_t time_us);

    /// Predicts the track at a time after the last accepted sighting. The verdict of the result is
    /// `none`. Returns nullopt while the camera is lost, or if the time is before that sighting.
    std::optional<SpaceTrack> predict(std::int64_t time_us) const;

    const SpaceTrack& track() const { return track_; }

  private:
    void start(const SpaceSighting& sighting);
    void reject(const SpaceSighting& sighting);
    bool take(const SpaceSighting& sighting);

    SpaceTrackOptions options_;
    SpaceTrack track_;
    space_track::Motion motion_;
    std::int64_t accepted_us_ = 0;  ///< time of the latest accepted sighting
    // The newest unambiguous sighting that was rejected after `accepted_us_`. `rejections_` is the
    // length of the run of rejected sightings that ends with this sighting. In a run, each sighting
    // is consistent with the previous sighting.
    std::optional<SpaceSighting> rejected_;
    int rejections_ = 0;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
