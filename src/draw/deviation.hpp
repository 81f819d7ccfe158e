/// Formats standard deviations.
#pragma once

#include <string>

#include <fmt/core.h>

namespace dotpose::draw {

/// Returns " +- VALUE" with `decimals` decimals. If all digits would be 0, returns one significant
/// digit instead. Returns an empty string if the deviation is exactly 0, which means that the value
/// was given rather than measured.
inline std::string plus_minus(double sigma, int decimals) {
    if (sigma == 0) return {};
    const std::string text = fmt::format("{:.{}f}", sigma, decimals);
    const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
    return " +- " + (is_zero ? fmt::format("{:.1g}", sigma) : text);
}

}  // namespace dotpose::draw
