/// Conversion of angles.
#pragma once

#include <numbers>

#include "dotpose/language.hpp"

namespace dotpose {

/// Number of degrees per radian.
inline constexpr double kDegrees = 180 / std::numbers::pi;

}  // namespace dotpose
