// The constant-velocity filter: a Kalman filter with the state (x, y, theta) and its velocities,
// which both stay constant but for an acceleration that is drawn anew for every interval.
//
// Bar-Shalom, Li, Kirubarajan: Estimation with Applications to Tracking and Navigation, 6.3.2.
#pragma once

#include "dotpose/track.hpp"

namespace dotpose::track {

using Vector3 = std::array<float, 3>;
using Matrix3 = std::array<Vector3, 3>;

inline constexpr float kRad_per_bam = 1.46291808e-9F;  // pi / 2^31

/// A pose as it is known from one sighting: the velocities are not.
TrackedPose started_at(const Sighting& sighting, const TrackOptions& options);

/// The pose at a later time.
TrackedPose predicted(const TrackedPose& pose, std::int64_t time_us, const TrackOptions& options);

/// How far a sighting is from a prediction for its time.
struct Innovation {
    Vector3 difference{};  ///< mm, mm, rad in [-pi, pi)
    Matrix3 covariance{};
};
Innovation innovation(const TrackedPose& predicted, const Sighting& sighting,
                      const TrackOptions& options);

/// The prediction corrected by the sighting.
TrackedPose corrected(const TrackedPose& predicted, const Sighting& sighting,
                      const TrackOptions& options);

}  // namespace dotpose::track
