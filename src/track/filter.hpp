// A Kalman filter whose state is (x, y, theta) with velocities and accelerations. The accelerations
// decay towards zero and are driven by white noise (Singer 1970). The variance of the noise, the
// agility, is adapted to the motion of the robot.
//
// Bar-Shalom, Li, Kirubarajan: Estimation with Applications to Tracking and Navigation, sections
// 8.2 (the model) and 11.2 (fitting the model).
#pragma once

#include "dotpose/track.hpp"

namespace dotpose::track {

inline constexpr float kRad_per_bam = 1.46291808e-9F;  // pi / 2^31

/// Returns the pose of a sighting. The velocities and the covariance are zero.
TrackedPose pose_of(const Sighting& sighting);

/// Returns the state after the first sighting. The velocities are 0, with a standard deviation of
/// half the maximum speed or turn rate.
MotionEstimate started_at(const Sighting& sighting, const TrackOptions& options);

/// Returns the state predicted for a later time.
MotionEstimate predicted(const MotionEstimate& motion, std::int64_t time_us,
                         const TrackOptions& options);

/// Returns the state predicted for a later time, corrected by a measured motion.
MotionEstimate carried(const MotionEstimate& motion, const MeasuredMotion& measured,
                       std::int64_t time_us, bool is_y_up, const TrackOptions& options);

/// Returns b - a: x and y in mm, and the angle in rad, in [-pi, pi).
Vector3 difference(const TrackedPose& a, const TrackedPose& b);

/// Difference between a sighting and the prediction for its time, with its covariance.
struct Innovation {
    Vector3 difference{};
    Matrix3 covariance{};
};
Innovation innovation(const MotionEstimate& predicted, const Sighting& sighting,
                      const TrackOptions& options);

/// Returns the prediction with agility and covariance adapted to the sighting. `dt_s` is the time
/// since the previous sighting.
MotionEstimate fitted(const MotionEstimate& predicted, const Sighting& sighting, float dt_s,
                      const TrackOptions& options);

/// Returns the prediction corrected by the sighting.
MotionEstimate corrected(const MotionEstimate& predicted, const Sighting& sighting,
                         const TrackOptions& options);

}  // namespace dotpose::track
