#pragma once

#include <numbers>

namespace dotpose {

/// Degrees in a radian.
inline constexpr double kDegrees = 180 / std::numbers::pi;

}  // namespace dotpose
