// Exponential: the exponential function and the natural logarithm in single precision. The results
// are bit-identical on all platforms, unlike the results of C libraries.
#pragma once

#include <cstdint>

#include "core/math/odds.hpp"

namespace dotpose::core {

/// ln 2 = kLn2High + kLn2Low. kLn2High has nine significant bits, so its products with integers up
/// to 2^15 are exact.
inline constexpr float kLn2High = 0.693359375F;
inline constexpr float kLn2Low = -2.121944401e-4F;

/// Returns e^x for x < 88, with a relative error of at most 2^-22. Returns 0 for x <= -87.
inline float natural_exp(float x) {
    constexpr float kLog2OfE = 1.442695041F;
    if (!(x > -87)) return 0;
    const auto exponent = static_cast<int>(x * kLog2OfE + (x < 0 ? -0.5F : 0.5F));
    const auto whole = static_cast<float>(exponent);
    const float rest = (x - whole * kLn2High) - whole * kLn2Low;
    // Taylor series up to the seventh power. The remainder is below 2^-27 for |rest| <= ln 2 / 2.
    constexpr float kSeries[] = {1.0F / 720, 1.0F / 120, 1.0F / 24, 1.0F / 6, 0.5F, 1, 1};
    float sum = 1.0F / 5040;
    for (const float coefficient : kSeries)
        sum = sum * rest + coefficient;
    return sum * power_of_two_exactly(exponent);
}

/// Returns ln x for x > 0. x must not be subnormal. The error is at most 2^-22 max(1, |result|).
inline float natural_log(float x) {
    constexpr float kRootHalf = 0.7071067812F;
    const auto bits = __builtin_bit_cast(std::int32_t, x);
    int exponent = (bits >> 23) - 126;
    float mantissa = __builtin_bit_cast(float, (bits & 0x007fffff) | 0x3f000000);  // in [0.5, 1)
    if (mantissa < kRootHalf) {
        mantissa *= 2;
        --exponent;
    }
    // Computes ln m = 2 artanh t from the series of artanh up to the ninth power.
    const float t = (mantissa - 1) / (mantissa + 1);
    const float square = t * t;
    constexpr float kSeries[] = {1.0F / 7, 1.0F / 5, 1.0F / 3, 1};
    float sum = 1.0F / 9;
    for (const float coefficient : kSeries)
        sum = sum * square + coefficient;
    const auto whole = static_cast<float>(exponent);
    return whole * kLn2High + (whole * kLn2Low + 2 * t * sum);
}

}  // namespace dotpose::core
