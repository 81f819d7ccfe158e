// Fixed: integer and fixed-point arithmetic for all stages. Binary angles are in units of 2^-32
// turns.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "dotpose/geometry.hpp"

namespace dotpose::core {

constexpr FixedVec operator+(FixedVec a, FixedVec b) {
    return {a.x + b.x, a.y + b.y};
}
constexpr FixedVec operator-(FixedVec a, FixedVec b) {
    return {a.x - b.x, a.y - b.y};
}
constexpr FixedVec operator-(FixedVec a) {
    return {-a.x, -a.y};
}

constexpr std::int64_t dot(FixedVec a, FixedVec b) {
    return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y;
}
constexpr std::int64_t cross(FixedVec a, FixedVec b) {
    return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
}
constexpr std::int64_t squared(FixedVec a) {
    return dot(a, a);
}

template <typename T>
constexpr T magnitude(T a) {
    return a < 0 ? -a : a;
}
/// Returns max(|x|, |y|).
constexpr std::int32_t larger_component(FixedVec a) {
    return std::max(magnitude(a.x), magnitude(a.y));
}
/// Returns true if |x| <= limit and |y| <= limit, for limit < 2^30.
constexpr bool is_within(FixedVec a, std::int32_t limit) {
    const auto reach = static_cast<std::uint32_t>(limit);
    return static_cast<std::uint32_t>(a.x) + reach <= 2 * reach &&
           static_cast<std::uint32_t>(a.y) + reach <= 2 * reach;
}

/// Returns n / d, rounded to nearest, with ties away from zero. Requires d > 0.
constexpr std::int64_t divide_rounded(std::int64_t n, std::int64_t d) {
    return (n >= 0 ? n + d / 2 : n - d / 2) / d;
}

/// Returns n / d, rounded towards zero. Requires d > 0 and a quotient that fits in 31 bits. On
/// processors without a divide instruction, this function is twice as fast as a 64-bit division.
std::int32_t short_quotient(std::int64_t n, std::int64_t d);

/// Returns numerator * 2^shift / denominator, rounded to nearest. Requires |numerator| < 2^62, 0 <
/// denominator < 2^62 and a result that fits in 31 bits.
std::int32_t scaled_quotient(std::int64_t numerator, std::int64_t denominator, int shift);

inline constexpr std::int64_t kOne_q30 = std::int64_t{1} << 30;

/// Returns both components divided by d_q30 / 2^30, each rounded to nearest. Requires d_q30 > 0.
constexpr FixedVec divided_q30(FixedVec n, std::int64_t d_q30) {
    return {static_cast<std::int32_t>(divide_rounded(n.x * kOne_q30, d_q30)),
            static_cast<std::int32_t>(divide_rounded(n.y * kOne_q30, d_q30))};
}

/// Returns the number of set bits. Sums fields of two, four and eight bits in parallel, which is
/// the fastest method on processors without a popcount instruction.
constexpr int bits_in(std::uint32_t word) {
    word -= word >> 1 & 0x55555555;
    word = (word & 0x33333333) + (word >> 2 & 0x33333333);
    word = (word + (word >> 4)) & 0x0F0F0F0F;
    return static_cast<int>(word * 0x01010101 >> 24);
}

/// Returns the value clamped to [-limit, limit].
constexpr std::int32_t limited(std::int64_t value, std::int32_t limit) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, -limit, limit));
}

/// Returns n / 2^bits, rounded to nearest, with ties rounded up. Requires bits > 0.
constexpr std::int32_t shift_rounded(std::int64_t n, int bits) {
    return static_cast<std::int32_t>((n + (std::int64_t{1} << (bits - 1))) >> bits);
}

/// Returns the largest r with r * r <= n. `Unsigned` has 32 or 64 bits.
template <typename Unsigned>
constexpr std::uint32_t square_root(Unsigned n) {
    Unsigned root = 0;
    for (Unsigned bit = (static_cast<Unsigned>(-1) >> 2) + 1; bit != 0; bit >>= 2) {
        if (n >= root + bit) {
            n -= root + bit;
            root = (root >> 1) + bit;
        } else {
            root >>= 1;
        }
    }
    return static_cast<std::uint32_t>(root);
}

/// Returns log2(n) in units of 2^-16, rounded down, for n >= 1.
std::int64_t log2_q16(std::uint32_t n);

/// Returns 2^(n / 256) in units of 2^-16, for 0 <= n < 47 * 256. The error is at most 0.4 %.
/// Interpolates linearly between powers of two and subtracts a correction.
constexpr std::int64_t exp2_q16(int n_q8) {
    const std::int32_t fraction_q8 = n_q8 & 255;
    // For the fraction f, 1 + f exceeds 2^f by about f (1 - f) / 3, which is less than 0.09.
    // 21846 / 2^16 is about 1/3.
    const std::int32_t mantissa_q16 =
        65536 + fraction_q8 * 256 - (fraction_q8 * (256 - fraction_q8) * 21846 >> 16);
    return std::int64_t{mantissa_q16} << (n_q8 >> 8);
}

/// Value that represents log2(0), in units of 2^-8.
inline constexpr int kNever_q8 = -(1 << 20);

/// log2(1 + 2^-d) in units of 2^-8, for d = 0, 1, ..., rounded up. The first entry is 255 instead
/// of 256 to fit in a byte, so `add_log2` adds 1. Because the function is convex, linear
/// interpolation gives an upper bound. The table is at namespace scope, because every inlined call
/// to `add_log2` would copy a local table.
inline constexpr std::array<std::uint8_t, 12> kGain{255, 150, 83, 44, 23, 12, 6, 3, 2, 1, 1, 1};

/// Returns an upper bound on log2(n) in units of 2^-8, for 0 < n < 2^24. Uses the bound log2(1 + f)
/// <= f + 0.087 for f in [0, 1).
constexpr int log2_at_most_q8(std::uint32_t n) {
    if (n == 1) return 0;
    const int whole = static_cast<int>(std::bit_width(n)) - 1;
    return whole * 256 + static_cast<int>(n << 8 >> whole) - 256 + 23;
}

/// Returns an upper bound on log2(2^a + 2^b). All logarithms are in units of 2^-8.
constexpr int add_log2(int a_q8, int b_q8) {
    const int larger = std::max(a_q8, b_q8);
    const int d = larger - std::min(a_q8, b_q8);
    const auto whole = static_cast<std::size_t>(d >> 8);
    if (whole + 1 >= kGain.size()) return larger + 1;
    const int fall = (kGain[whole] - kGain[whole + 1]) * (d & 255);
    return larger + kGain[whole] + 1 - (fall >> 8);
}

/// Returns the median, or 0 if there are no values. For an even number of values, returns the lower
/// median. Reorders the values.
std::int32_t median(std::span<std::int32_t> values);

/// Returns the upper quartile, or 0 if there are no values. Reorders the values.
std::int32_t upper_quartile(std::span<std::int32_t> values);

/// Returns the sine of a phase, times 2^14. Phases are in units of 2^-16 turns. The approximation
/// by two parabolas has an error of at most 6 %.
constexpr std::int32_t rough_sine(std::int32_t phase_q16) {
    const std::int32_t x = static_cast<std::int16_t>(phase_q16 & 0xFFFF);
    return x * (32768 - magnitude(x)) >> 14;
}
constexpr std::int32_t rough_cosine(std::int32_t phase_q16) {
    return rough_sine(phase_q16 + 16384);
}

/// Returns the binary angle of a vector, from +x towards +y. The error is about 1e-9 turns. The
/// angle of (0, 0) is 0. Requires |x|, |y| < 2^29.
std::int32_t angle_bam(FixedVec direction);

/// Returns (cosine, sine) of a binary angle, times 2^30.
FixedVec unit_q30(std::int32_t angle_bam);

}  // namespace dotpose::core
