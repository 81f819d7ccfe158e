/// Rounding of Python's numbers to the integers of the core.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dotpose::python {

/// Returns the nearest integer, at most the largest there is; 0 for what is no number.
inline std::int32_t rounded(double value) {
    if (std::isnan(value)) return 0;
    return static_cast<std::int32_t>(std::clamp(std::round(value),
                                                double{std::numeric_limits<std::int32_t>::min()},
                                                double{std::numeric_limits<std::int32_t>::max()}));
}

}  // namespace dotpose::python
