/// Rounds Python numbers to the integer types that the core uses.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dotpose::python {

/// Returns the nearest integer, clamped to the range of the type. Returns 0 for NaN.
inline std::int32_t rounded(double value) {
    if (std::isnan(value)) return 0;
    return static_cast<std::int32_t>(std::clamp(std::round(value),
                                                double{std::numeric_limits<std::int32_t>::min()},
                                                double{std::numeric_limits<std::int32_t>::max()}));
}

}  // namespace dotpose::python
