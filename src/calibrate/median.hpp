// Median of numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dotpose::calibrate {

/// Median of the squared length of a two-dimensional Gaussian vector with variance 1 per axis.
inline constexpr double kMedianOfSquaredLength = 1.386;
/// Squared length that a two-dimensional Gaussian vector with variance 1 per axis exceeds with a
/// probability of 1 in 4,000. Residuals with a greater squared length are outliers.
inline constexpr double kMaxSquaredLength = 16.6;

/// Returns the upper median. `values` must not be empty.
inline double upper_median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace dotpose::calibrate
