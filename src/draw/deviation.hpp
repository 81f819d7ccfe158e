/// Texts of standard deviations.
#pragma once

#include <string>

#include <fmt/core.h>

namespace dotpose::draw {

/// Returns " +- VALUE" with this many decimals, or with one significant digit where they would all
/// be 0; an empty text for a deviation of exactly 0, which belongs to what is given.
inline std::string plus_minus(double sigma, int decimals) {
    if (sigma == 0) return {};
    const std::string text = fmt::format("{:.{}f}", sigma, decimals);
    const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
    return " +- " + (is_zero ? fmt::format("{:.1g}", sigma) : text);
}

}  // namespace dotpose::draw
