/// Conversion of angles.
#pragma once

#include <numbers>

namespace dotpose {

/// Number of degrees per radian.
inline constexpr double kDegrees = 180 / std::numbers::pi;

}  // namespace dotpose
