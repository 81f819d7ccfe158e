// Kalman filter for (x, y, theta), with velocities and accelerations. Accelerations decay towards
// zero and are driven by white noise (Singer 1970). The filter multiplies the variance of this
// noise by a factor of at most 1, the agility, and adapts the agility to the robot's motion.
//
// Reference: Bar-Shalom, Li, Kirubarajan: Estimation with Applications to Tracking and Navigation,
// sections 8.2 (the model) and 11.2 (fitting the model).
#pragma once

#include "dotpose/track.hpp"

namespace dotpose::track {

inline constexpr float kRad_per_bam = 1.46291808e-9F;  // pi / 2^31

/// Converts a sighting to a pose. The velocities and the covariance of the pose are 0.
TrackedPose pose_of(const Sighting& sighting);

/// Returns the state after the first sighting. The velocities are 0, with a standard deviation of
/// half the maximum speed or turn rate.
MotionEstimate started_at(const Sighting& sighting, const TrackOptions& options);

/// Predicts the state at a later time.
MotionEstimate predicted(const MotionEstimate& motion, std::int64_t time_us,
                         const TrackOptions& options);

/// Predicts the state at a later time, and corrects the prediction with a measured motion.
MotionEstimate carried(const MotionEstimate& motion, const MeasuredMotion& measured,
                       std::int64_t time_us, bool is_y_up, const TrackOptions& options);

/// Returns b - a: x and y in mm, and the angle in rad, in [-pi, pi).
Vector3 difference(const TrackedPose& a, const TrackedPose& b);

/// A sighting minus the prediction for its time, with the covariance of this difference.
struct Innovation {
    Vector3 difference{};
    Matrix3 covariance{};
};
Innovation innovation(const MotionEstimate& predicted, const Sighting& sighting,
                      const TrackOptions& options);

/// Adapts the agility and the covariance of a prediction to the innovation of a sighting. `dt_s` is
/// the time since the previous sighting.
MotionEstimate fitted(const MotionEstimate& predicted, const Sighting& sighting, float dt_s,
                      const TrackOptions& options);

/// Corrects a prediction with a sighting.
MotionEstimate corrected(const MotionEstimate& predicted, const Sighting& sighting,
                         const TrackOptions& options);

}  // namespace dotpose::track
