// Integer arithmetic shared by the stages. Angles are binary: 2^32 is a full turn.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "dotpose/geometry.hpp"

namespace dotpose::core {

constexpr Vec operator+(Vec a, Vec b) {
    return {a.x + b.x, a.y + b.y};
}
constexpr Vec operator-(Vec a, Vec b) {
    return {a.x - b.x, a.y - b.y};
}
constexpr Vec operator-(Vec a) {
    return {-a.x, -a.y};
}

constexpr std::int64_t dot(Vec a, Vec b) {
    return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y;
}
constexpr std::int64_t cross(Vec a, Vec b) {
    return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
}
constexpr std::int64_t squared(Vec a) {
    return dot(a, a);
}

/// |a|, of any signed integer.
template <typename T>
constexpr T magnitude(T a) {
    return a < 0 ? -a : a;
}
/// max(|x|, |y|)
constexpr std::int32_t larger_component(Vec a) {
    return std::max(magnitude(a.x), magnitude(a.y));
}
/// Whether |x|, |y| <= limit < 2^30.
constexpr bool is_within(Vec a, std::int32_t limit) {
    const auto reach = static_cast<std::uint32_t>(limit);
    return static_cast<std::uint32_t>(a.x) + reach <= 2 * reach &&
           static_cast<std::uint32_t>(a.y) + reach <= 2 * reach;
}

/// Quotient rounded to nearest, halves away from zero. The divisor is positive.
constexpr std::int64_t divide_rounded(std::int64_t n, std::int64_t d) {
    return (n >= 0 ? n + d / 2 : n - d / 2) / d;
}

/// n / d for d > 0, of a quotient that fits 31 bits: where processors have no divider, that takes
/// half as long as any quotient.
std::int32_t short_quotient(std::int64_t n, std::int64_t d);

/// numerator * 2^shift / denominator, rounded to nearest. |numerator| < 2^62,
/// 0 < denominator < 2^62, the result must fit 31 bits.
std::int32_t scaled_quotient(std::int64_t numerator, std::int64_t denominator, int shift);

inline constexpr std::int64_t kOne_q30 = std::int64_t{1} << 30;

/// The quotients of both components, likewise.
constexpr Vec divided_q30(Vec n, std::int64_t d_q30) {
    return {static_cast<std::int32_t>(divide_rounded(n.x * kOne_q30, d_q30)),
            static_cast<std::int32_t>(divide_rounded(n.y * kOne_q30, d_q30))};
}

/// How many bits are set: in sums of two, four and eight bits side by side, as small processors do
/// it best.
constexpr int bits_in(std::uint32_t word) {
    word -= word >> 1 & 0x55555555;
    word = (word & 0x33333333) + (word >> 2 & 0x33333333);
    word = (word + (word >> 4)) & 0x0F0F0F0F;
    return static_cast<int>(word * 0x01010101 >> 24);
}

/// The value, or the limit of its sign where it goes beyond that.
constexpr std::int32_t limited(std::int64_t value, std::int32_t limit) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, -limit, limit));
}

/// n / 2^bits, rounded to nearest, halves up.
constexpr std::int32_t shift_rounded(std::int64_t n, int bits) {
    return static_cast<std::int32_t>((n + (std::int64_t{1} << (bits - 1))) >> bits);
}

/// Largest r with r * r <= n, of 32 or 64 bits.
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

/// log2(n) in 2^-16, rounded down, for n >= 1.
std::int64_t log2_q16(std::uint32_t n);

/// 2^(n / 256), in 2^-16, to 2 %, for 0 <= n < 47 * 256: linear between whole powers, corrected.
constexpr std::int64_t exp2_q16(int n_q8) {
    const std::int32_t fraction_q8 = n_q8 & 255;
    // 2^f is below 1 + f by at most 0.086, about f (1 - f) / 3: 21846 / 2^16 is as good as a third.
    const std::int32_t mantissa_q16 =
        65536 + fraction_q8 * 256 - (fraction_q8 * (256 - fraction_q8) * 21846 >> 16);
    return std::int64_t{mantissa_q16} << (n_q8 >> 8);
}

/// log2 of zero, as good as, in 2^-8.
inline constexpr int kNever_q8 = -(1 << 20);

/// log2(1 + 2^-d) in 2^-8 for d = 0, 1, ...; it is convex, and so below the chord in between.
// Outside the function: inside, each call would copy it.
inline constexpr std::array<std::uint8_t, 12> kGain{255, 150, 83, 44, 23, 12, 6, 3, 2, 1, 1, 1};

/// log2(n) for 0 < n < 2^24 in 2^-8, rounded up: log2(1 + f) is at most f + 0.087.
constexpr int log2_at_most_q8(std::uint32_t n) {
    if (n == 1) return 0;
    const int whole = static_cast<int>(std::bit_width(n)) - 1;
    return whole * 256 + static_cast<int>(n << 8 >> whole) - 256 + 23;
}

/// log2(2^a + 2^b) in 2^-8, rounded up.
constexpr int add_log2(int a_q8, int b_q8) {
    const int larger = std::max(a_q8, b_q8);
    const int d = larger - std::min(a_q8, b_q8);
    const auto whole = static_cast<std::size_t>(d >> 8);
    if (whole + 1 >= kGain.size()) return larger + 1;
    const int fall = (kGain[whole] - kGain[whole + 1]) * (d & 255);
    return larger + kGain[whole] + 1 - (fall >> 8);
}

/// Median (the lower one of two); the order of the values is lost. Empty gives 0.
std::int32_t median(std::span<std::int32_t> values);

/// The value that a quarter of all exceed; likewise.
std::int32_t upper_quartile(std::span<std::int32_t> values);

/// A sine to 6 %: two parabolas. Phases are in 2^-16 turns, values times 2^14.
constexpr std::int32_t rough_sine(std::int32_t phase_q16) {
    const std::int32_t x = static_cast<std::int16_t>(phase_q16 & 0xFFFF);
    return x * (32768 - magnitude(x)) >> 14;
}
constexpr std::int32_t rough_cosine(std::int32_t phase_q16) {
    return rough_sine(phase_q16 + 16384);
}

/// Angle of a vector from +x towards +y, to about 1e-9 turns; (0, 0) gives 0. |x|, |y| < 2^29.
std::int32_t angle_bam(Vec direction);

/// Cosine and sine, times 2^30.
Vec unit_q30(std::int32_t angle_bam);

}  // namespace dotpose::core
