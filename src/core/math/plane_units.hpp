// Plane units: conversion of planes between fixed point and floating point.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/math/plane.hpp"

namespace dotpose::core {

inline constexpr float kPower16 = 65536.0F;
inline constexpr float kPower24 = 16777216.0F;
inline constexpr float kPower30 = 1073741824.0F;
inline constexpr float kPower40 = kPower24 * kPower16;

/// Returns the integer nearest to `value`, clamped to +-kBeyondReason. Returns -kBeyondReason for
/// NaN.
inline std::int32_t rounded(float value) {
    constexpr float kMax = kBeyondReason;
    const float whole = value + (value < 0 ? -0.5F : 0.5F);
    // With this order of min and max, NaN gives -kMax.
    return static_cast<std::int32_t>(std::min(std::max(-kMax, whole), kMax));
}

/// Returns the whole number nearest to `value`, with ties rounded to even, for |value| < 2^22. Like
/// the kernels, adds 1.5 * 2^23, which leaves no fractional bits.
inline float nearest_whole(float value) {
    constexpr float kRounder = 12582912;
    return (value + kRounder) - kRounder;
}

}  // namespace dotpose::core
