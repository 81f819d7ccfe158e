// The filter: a Kalman filter with the state (x, y, theta), its velocities and its accelerations,
// which decay towards zero and are pushed anew all the time (Singer 1970). How hard they are pushed
// is fitted to how the robot moves.
//
// Bar-Shalom, Li, Kirubarajan: Estimation with Applications to Tracking and Navigation, 8.2 (the
// model) and 11.2 (fitting it).
#pragma once

#include "dotpose/track.hpp"

namespace dotpose::track {

inline constexpr float kRad_per_bam = 1.46291808e-9F;  // pi / 2^31

/// Without velocities and covariance.
TrackedPose pose_of(const Sighting& sighting);

/// What is known from one sighting: the velocities are not.
Motion started_at(const Sighting& sighting, const TrackOptions& options);

/// At a later time.
Motion predicted(const Motion& motion, std::int64_t time_us, const TrackOptions& options);

/// b - a in mm, mm and rad in [-pi, pi).
Vector3 difference(const TrackedPose& a, const TrackedPose& b);

/// How far a sighting is from a prediction for its time.
struct Innovation {
    Vector3 difference{};
    Matrix3 covariance{};
};
Innovation innovation(const Motion& predicted, const Sighting& sighting,
                      const TrackOptions& options);

/// The prediction with its agility, and its covariance with it, fitted to the sighting. The robot
/// was seen `dt_s` before.
Motion fitted(const Motion& predicted, const Sighting& sighting, float dt_s,
              const TrackOptions& options);

/// The prediction corrected by the sighting.
Motion corrected(const Motion& predicted, const Sighting& sighting, const TrackOptions& options);

}  // namespace dotpose::track
