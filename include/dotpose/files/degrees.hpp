/// Conversion of angles.
#pragma once

namespace dotpose {

/// Number of degrees per radian.
inline constexpr double kDegrees = 180 / 3.14159265358979323846;

}  // namespace dotpose
