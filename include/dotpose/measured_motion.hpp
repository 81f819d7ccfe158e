/// Measured motion: the displacement and rotation of the camera between two frames, from wheel
/// odometry or an inertial measurement unit. A Locator uses it to combine the bits of several
/// frames if a single frame does not determine a reliable position. A Tracker uses it to follow a
/// robot over areas without a pattern.
#pragma once

#include "dotpose/export.hpp"
#include "dotpose/language.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Camera motion since the previous frame, with its uncertainty. The displacement is the motion of
/// the reference point along the axes of the previous image.
struct MeasuredMotion {
    float right_mm = 0;  ///< displacement along the image x axis
    float down_mm = 0;   ///< displacement along the image y axis
    float turn_rad = 0;  ///< change of `Fix::theta_rad`, clockwise on the paper
    /// Standard deviations of the displacement along each axis, and of the rotation. The errors are
    /// assumed to be independent and normally distributed. If the values are too small, fixes may
    /// be wrong.
    float sigma_mm = 0;
    float sigma_rad = 0;

    /// Returns true if all values are finite and less than 1e6 in magnitude, and no standard
    /// deviation is negative. A Locator or Tracker ignores motions that are not usable.
    bool is_usable() const;
};

/// Returns the composition of two successive motions.
MeasuredMotion followed_by(const MeasuredMotion& first, const MeasuredMotion& second);

}  // namespace dotpose

DOTPOSE_END_EXPORT
