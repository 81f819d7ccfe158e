// Odds: converts floating-point numbers to and from base-2 logarithms.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/math/fixed.hpp"

namespace dotpose::core {

/// Returns 2^max(n, -126) exactly, for n < 128.
constexpr float power_of_two_exactly(int n) {
    return __builtin_bit_cast(float, static_cast<std::uint32_t>(std::max(n, -126) + 127) << 23);
}

/// Returns 2^(n / 256) for n < 127 * 256, where n is `n_q8`. The error is at most 0.4 %. Values of
/// n below -25,600 are treated as -25,600.
constexpr float power_of_two(int n_q8) {
    const int n = std::max(n_q8, -100 * 256);
    const int whole = n >> 8;
    return static_cast<float>(exp2_q16(n - whole * 256)) * power_of_two_exactly(whole - 16);
}

/// Returns an upper bound on 2^(n / 256), where n is `n_q8`. The result is at most 3 % too large.
/// Arguments are as for `power_of_two`.
constexpr float power_of_two_rounded_up(int n_q8) {
    return 1.02F * power_of_two(n_q8);
}

/// Returns an upper bound on log2(odds), in units of 2^-8. Odds below 1e-30 are treated as 1e-30.
inline int log2_of_odds_q8(float odds) {
    int exponent = 0;
    const float mantissa = std::frexp(std::max(odds, 1e-30F), &exponent);
    return log2_at_most_q8(static_cast<std::uint32_t>(mantissa * 65536)) + 256 * (exponent - 16);
}

}  // namespace dotpose::core
