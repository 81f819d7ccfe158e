/// Tracker: follows a robot from frame to frame. An adaptive filter estimates position, angle and
/// velocities, with their covariance. The tracker reports the events `fix`, `lost`, `kidnapped`,
/// `stationary` and `moving`. docs/tracking.md explains the filter, the events and weak fixes.
///
///     Tracker tracker;
///     for (;;) {
///         const Fix fix = locator.locate(image);
///         const bool ok = fix.status == Status::ok;
///         const Sighting sighting = sighting_of(fix, time_us);
///         const Track& track = tracker.update(time_us, ok ? &sighting : nullptr);
///     }
///
/// `predict` returns the expected pose in the next frame. examples/follow_robot.cpp shows its use.
///
/// Coordinates: all poses are in the plane of the sightings, which is the pattern frame or, for a
/// robot that drives between sheets, the world frame of a sheet file. Positions are integers in
/// nanometres, which cover the whole pattern plane (2.1e14 nm). Angles are binary angles, measured
/// from +x towards +y. 2^31 is half a turn. Velocities are in mm/s along x and y. Angular
/// velocities are in rad/s.
///
/// The functions use no heap, no double precision and no global variables. Different trackers may
/// be used concurrently.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

#include "dotpose/device_options.hpp"
#include "dotpose/export.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/measured_motion.hpp"
#include "dotpose/prediction.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Covariance of (x, y, theta) and their velocities, in units of mm, rad and s.
using Covariance6 = std::array<std::array<float, 6>, 6>;

/// Robot position and angle, measured in one frame.
struct Sighting {
    std::int64_t time_us = 0;  ///< middle of the exposure, on any clock
    std::int64_t x_nm = 0;
    std::int64_t y_nm = 0;
    std::int32_t theta_bam = 0;
    /// ID of the plane that contains the pose. Poses in different planes are unrelated.
    std::uint32_t plane = 0;
    /// Covariance of x, y and theta, in mm and rad.
    std::array<std::array<float, 3>, 3> covariance{};
    /// Upper bound on the probability that the position is wrong, as log2 (see Fix). The sighting
    /// is *weak* if this value exceeds TrackOptions::max_p_wrong_log2.
    int p_wrong_log2 = 0;
    std::int32_t spacing_nm = 508'000;  ///< spacing of the pattern in view
    /// True if the y axis of the plane points up on the paper. Angles then have the opposite sign
    /// to angles in the pattern.
    bool is_y_up = false;
};

/// Converts a fix to a sighting in the pattern frame. The plane ID is the section of the fix. The
/// fix must have the status ok, and its spacing must be known and at most 20 mm.
Sighting sighting_of(const Fix& fix, std::int64_t time_us);

/// Limits on the robot's motion, and criteria for accepting sightings.
struct TrackOptions {
    /// Standard deviation of the robot's acceleration while it manoeuvres. The filter lowers this
    /// value automatically during steady motion. A larger value makes the filter follow sudden
    /// changes faster. The default suits a table-top robot.
    float acceleration_mm_s2 = 600;
    float angular_acceleration_rad_s2 = 6;

    /// Maximum possible acceleration, for example in a collision. A sighting that implies a larger
    /// acceleration is accepted only after further sightings confirm it.
    float max_acceleration_mm_s2 = 10'000;
    float max_angular_acceleration_rad_s2 = 200;
    /// Maximum speed. It limits how far the robot can have moved since its last sighting.
    float max_speed_mm_s = 1000;
    float max_turn_rad_s = 20;
    /// Tolerance of the gate, in standard deviations of the innovation (the difference between the
    /// sighting and its prediction). A sighting is inside the gate if the innovation is at most
    /// this tolerance plus the motion that the maximum accelerations can cause.
    float gate_sigmas = 5;
    /// Number of consecutive sightings that must be consistent with each other before a jump is
    /// accepted. A larger number delays the acceptance. With a smaller number, wrong fixes may be
    /// accepted.
    int confirmations = 3;

    /// The robot is lost if the latest accepted sighting or measured motion is at least this old.
    std::int64_t lost_after_us = 70'000;
    /// Maximum standard deviation of the position along either axis while only measured motions
    /// update the pose. Above this limit, the robot is lost.
    float max_sigma_mm = 5;

    /// Limits for detecting a stationary robot. The robot is stationary if its pose changes by at
    /// most these limits along each axis for `stationary_after_us`.
    float still_mm = 0.1F;
    float still_rad = 0.02F;
    std::int64_t stationary_after_us = 500'000;

    /// Standard deviations of printing errors. Their squares are added to the covariance of each
    /// sighting. Printing errors do not average out, because they are the same in all frames that
    /// show the same part of the paper.
    float min_sigma_mm = 0.0002F;
    float min_sigma_rad = 0.00002F;

    /// Maximum accepted bound on the probability that a sighting is wrong, as log2. The bound of a
    /// weak sighting is computed with the *prior*: the assumption that the robot is inside the
    /// gate.
    int max_p_wrong_log2 = -30;
    /// Maximum `p_wrong_log2` of an accepted weak sighting, computed without the prior. Must be at
    /// most -1.
    int max_weak_p_wrong_log2 = -10;
    /// Pattern spacing, which determines how many places of the code are inside the gate.
    float spacing_mm = 0.508F;
};

/// Robot pose and velocities.
struct TrackedPose {
    std::int64_t time_us = 0;
    std::int64_t x_nm = 0;
    std::int64_t y_nm = 0;
    std::int32_t theta_bam = 0;
    std::uint32_t plane = 0;
    float vx_mm_s = 0;
    float vy_mm_s = 0;
    float turn_rad_s = 0;
    Covariance6 covariance{};

    // The functions below are inline, because the object code for devices must not use double
    // precision.
    double x_mm() const { return static_cast<double>(x_nm) * 1e-6; }
    double y_mm() const { return static_cast<double>(y_nm) * 1e-6; }
    /// Angle in [-pi, pi).
    double theta_rad() const { return theta_bam * (std::numbers::pi / 2147483648.0); }
};

/// The tracker's verdict on the sighting in a frame.
enum class Verdict : std::uint8_t {
    none,  ///< there was no sighting
    /// The sighting is certain enough without the prior, and its pose is possible or confirmed.
    /// While the robot is tracked, a pose is possible if it is inside the gate. While the robot is
    /// lost, a pose is possible if the robot could have reached it. The pose of the first sighting
    /// is always possible. A pose is confirmed after TrackOptions::confirmations sightings that are
    /// consistent with each other.
    accepted,
    /// The sighting is weak, but certain enough together with the prior.
    with_prior,
    /// The sighting is certain enough without the prior, but its pose is neither possible nor
    /// confirmed yet.
    gated,
    /// The sighting is weak and was rejected: the robot is lost, or the sighting is outside the
    /// gate or not certain enough even with the prior.
    too_weak,
};
/// Number of verdicts.
inline constexpr int kVerdictCount = 5;
/// Returns the identifier, such as "with_prior".
const char* name(Verdict verdict) noexcept;

/// Events in a frame. Several events may occur together.
struct TrackEvents {
    bool fix = false;  ///< the robot was found, for the first time or after being lost
    /// The tracker has lost the robot, because there was no accepted sighting or motion for
    /// TrackOptions::lost_after_us, or because the uncertainty exceeds TrackOptions::max_sigma_mm.
    bool lost = false;
    /// The robot has been moved by hand: confirmed sightings show it at a pose that it cannot have
    /// reached by driving since its last accepted sighting.
    bool kidnapped = false;
    bool stationary = false;  ///< the robot came to rest
    bool moving = false;      ///< the robot moves again after being stationary
};

/// State after a frame.
struct Track {
    bool is_lost = true;
    bool is_stationary = false;
    Verdict verdict = Verdict::none;
    /// Upper bound on the probability that the pose is wrong, as log2. 0 if the frame has no
    /// accepted sighting. The bound of a weak sighting is computed with the prior.
    int p_wrong_log2 = 0;
    TrackEvents events;
    /// Pose at the time of the latest frame. It is a prediction if the frame had no accepted
    /// sighting. Not valid while the robot is lost.
    TrackedPose pose;
};

/// Implementation details of Tracker: the filter state. Not part of the public API.
namespace track {

using Vector3 = std::array<float, 3>;
using Matrix3 = std::array<Vector3, 3>;
using Vector9 = std::array<float, 9>;
using Covariance9 = std::array<Vector9, 9>;

/// State of the filter.
struct MotionEstimate {
    TrackedPose pose;
    Vector3 acceleration{};  ///< mm/s^2, rad/s^2
    /// Covariance of (x, y, theta), their velocities and their accelerations.
    Covariance9 covariance{};
    /// Agility of each axis: a factor of at most 1, by which the filter multiplies the variance of
    /// the acceleration along this axis. TrackOptions contains the standard deviation for a factor
    /// of 1.
    Vector3 agility{1, 1, 1};
    Vector3 innovation{};  ///< difference between the newest sighting and its prediction
    Matrix3 noise{};       ///< covariance of the newest sighting, including printing errors
    /// Running mean of the normalised innovation squared, divided by its three degrees of freedom.
    /// It is 1 if the innovations are as large as predicted.
    float scatter = 1;
};

}  // namespace track

/// Follows one robot from sighting to sighting.
class Tracker {
  public:
    /// Starts in the `lost` state.
    explicit Tracker(const TrackOptions& options = {}) : options_(options) {}

    /// Updates the state with a frame. `sighting` is null if the frame has no fix. A frame that is
    /// not newer than the previous frame only clears the events.
    const Track& update(std::int64_t time_us, const Sighting* sighting);

    /// Updates the state with a frame and with the motion that odometry has measured since the
    /// previous update. `right_mm` is measured along the direction given by the theta of the
    /// sightings. This is the image x axis, or the robot's heading if a camera file is used. The
    /// motion advances the pose, and the uncertainty of the motion increases the covariance of the
    /// pose. An accepted sighting then corrects the pose and reduces its covariance.
    const Track& update(std::int64_t time_us, const Sighting* sighting,
                        const MeasuredMotion& motion);

    /// Returns the state after the newest frame.
    const Track& track() const { return track_; }

    /// Predicts the pose in the frame at `time_us`. `newest` must be a fix with status ok, and
    /// `seen` must be its sighting. The prediction is the map of `newest`, moved to the pose that
    /// the filter predicts, with the uncertainty of that pose. If `seen` is not accepted yet, the
    /// prediction is computed from `seen` and the earlier sightings that are consistent with it.
    ///
    /// Returns Prediction::like(newest) if no prediction is possible, that is, if:
    /// - `seen` is neither the newest sighting of the track nor the newest sighting that is
    ///   inconsistent with the track,
    /// - the robot will be considered lost at `time_us`,
    /// - `time_us` is not after the time of `seen`,
    /// - the spacing is not known, or
    /// - the predicted motion along x or y is 2048 spacings or more.
    ///
    /// `options` are the options of the Locator.
    Prediction predict(std::int64_t time_us, const Fix& newest, const Sighting& seen,
                       const DeviceOptions& options) const;

    /// Returns true if a weak sighting in the next frame could be accepted. The frame can then be
    /// located with a relaxed IntegrityOptions::max_p_wrong_log2.
    bool has_prior() const { return !track_.is_lost; }

  private:
    /// Returns the motion estimate whose newest sighting is `seen`, or null if there is none.
    const track::MotionEstimate* following(const Sighting& seen) const;
    const Track& update(std::int64_t time_us, const Sighting* sighting,
                        const MeasuredMotion* motion);
    /// Returns the verdict on a sighting. `dt_s` is the time since the previous state, in seconds.
    /// If the frame has a measured motion, `last_` must already include it.
    Verdict judge(const track::MotionEstimate& prediction, const Sighting& sighting, float dt_s);
    bool is_confirmed(const Sighting& sighting);
    /// Returns true if the robot must be considered lost: the last accepted sighting or motion is
    /// too old, or the position is too uncertain.
    bool is_stale() const;
    void restart(const track::MotionEstimate& motion);
    void watch_motion();

    TrackOptions options_;
    Track track_;
    bool was_seen_ = false;  ///< true if any sighting has been accepted
    bool has_frame_ = false;
    bool is_y_up_ = false;        ///< true if y points up in the newest sighting's plane
    std::int64_t newest_us_ = 0;  ///< time of the newest frame
    /// Filter state after the newest accepted sighting or measured motion.
    track::MotionEstimate last_;
    /// Estimate from the newest sightings that are inconsistent with the track. It is filtered like
    /// the track, because it replaces the track if further sightings confirm that the robot was
    /// moved.
    track::MotionEstimate candidate_;
    int agreeing_ = 0;  ///< number of sightings in `candidate_`
    TrackedPose rest_;  ///< reference pose for detecting movement
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
