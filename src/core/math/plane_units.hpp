// Units of the fixed-point maps as floating-point numbers.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/math/plane.hpp"

namespace dotpose::core {

inline constexpr float kPower16 = 65536.0F;
inline constexpr float kPower24 = 16777216.0F;
inline constexpr float kPower30 = 1073741824.0F;
inline constexpr float kPower40 = kPower24 * kPower16;

/// Returns the nearest whole number, limited to +-kBeyondReason; for a value that is not a number,
/// the lower limit.
inline std::int32_t rounded(float value) {
    constexpr float kMost = kBeyondReason;
    const float whole = value + (value < 0 ? -0.5F : 0.5F);
    // The order of min and max matters for a value that is not a number.
    return static_cast<std::int32_t>(std::min(std::max(-kMost, whole), kMost));
}

}  // namespace dotpose::core
