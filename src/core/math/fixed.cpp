#include "core/math/fixed.hpp"

#include <array>
#include <bit>

namespace dotpose::core {
namespace {

/// Rotation angles of CORDIC (Volder 1959): atan(2^-i) as binary angles, for i = 0..29.
constexpr std::array<std::int32_t, 30> kAtan{
    536870912, 316933406, 167458907, 85004756, 42667331, 21354465, 10679838, 5340245,
    2670163,   1335087,   667544,    333772,   166886,   83443,    41722,    20861,
    10430,     5215,      2608,      1304,     652,      326,      163,      81,
    41,        20,        10,        5,        3,        1};

/// 2^30 times the product of all cos(atan(2^-i)). The CORDIC rotations multiply the length of a
/// vector by the inverse of this product.
constexpr std::int32_t kCordicGain_q30 = 652032874;

constexpr std::int32_t kHalfTurn = INT32_MIN;

std::int32_t middle(std::int32_t a, std::int32_t b, std::int32_t c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

/// Returns the value that would be at index `rank` after sorting (Hoare's FIND, 1961). Reorders the
/// values.
std::int32_t of_rank(std::size_t rank, std::span<std::int32_t> values) {
    std::int32_t* const wanted = &values[rank];
    std::int32_t* first = values.data();
    std::int32_t* last = first + values.size() - 1;
    while (first < last) {
        const std::int32_t pivot = middle(*first, first[(last - first) / 2], *last);
        std::int32_t* low = first;
        std::int32_t* high = last;
        while (low <= high) {
            while (*low < pivot)
                ++low;
            while (*high > pivot)
                --high;
            if (low <= high) std::swap(*low++, *high--);
        }
        // All values between `high` and `low` equal the pivot.
        if (wanted > high) first = low;
        if (wanted < low) last = high;
        if (wanted > high && wanted < low) break;
    }
    return *wanted;
}

}  // namespace

std::int32_t short_quotient(std::int64_t n, std::int64_t d) {
    auto rest = static_cast<std::uint64_t>(magnitude(n));
    auto divisor = static_cast<std::uint64_t>(d);
    int bit = std::countl_zero(divisor | 1) - std::countl_zero(rest | 1);
    divisor <<= std::max(bit, 0);
    std::uint32_t quotient = 0;
    for (; bit >= 0; --bit) {
        quotient *= 2;
        if (rest >= divisor) {
            rest -= divisor;
            ++quotient;
        }
        rest *= 2;
    }
    return static_cast<std::int32_t>(n < 0 ? 0 - quotient : quotient);
}

std::int32_t scaled_quotient(std::int64_t numerator, std::int64_t denominator, int shift) {
    if (shift > 0) {
        // Shifts the numerator left by up to `shift` bits while its magnitude remains below 2^62,
        // and the denominator right by the remaining bits.
        const auto bits = std::bit_width(static_cast<std::uint64_t>(magnitude(numerator)));
        const int up = std::clamp(62 - static_cast<int>(bits), 0, shift);
        numerator *= std::int64_t{1} << up;
        shift -= up;
        denominator >>= shift;
        shift = 0;
    }
    denominator = std::max<std::int64_t>(denominator, 1);
    if (shift < 0) return shift_rounded(divide_rounded(numerator, denominator), -shift);
    const std::int64_t half = denominator / 2;
    return short_quotient(numerator >= 0 ? numerator + half : numerator - half, denominator);
}

std::int64_t log2_q16(std::uint32_t n) {
    // Computes the logarithm bit by bit. Squaring the mantissa doubles its logarithm, so the
    // integer part of the doubled logarithm is the next bit.
    int whole = 0;
    while (n >> whole > 1)
        ++whole;
    std::uint64_t mantissa_q30 = (std::uint64_t{n} << 30) >> whole;
    std::int64_t log = whole;
    for (int bit = 0; bit < 16; ++bit) {
        mantissa_q30 = (mantissa_q30 * mantissa_q30) >> 30;
        log *= 2;
        if (mantissa_q30 >= std::uint64_t{2} << 30) {
            mantissa_q30 >>= 1;
            ++log;
        }
    }
    return log;
}

std::int32_t median(std::span<std::int32_t> values) {
    return values.empty() ? 0 : of_rank((values.size() - 1) / 2, values);
}

std::int32_t upper_quartile(std::span<std::int32_t> values) {
    return values.empty() ? 0 : of_rank((values.size() - 1) * 3 / 4, values);
}

std::int32_t angle_bam(FixedVec direction) {
    std::int64_t x = direction.x;
    std::int64_t y = direction.y;
    if (x == 0 && y == 0) return 0;
    std::uint32_t angle = 0;
    if (x < 0) {
        x = -x;
        y = -y;
        angle = static_cast<std::uint32_t>(kHalfTurn);
    }
    // Scales the vector to 41 bits. The truncation errors of all steps then add up to much less
    // than the last angle in the table.
    const auto bits = std::bit_width(static_cast<std::uint64_t>(x + magnitude(y)));
    x <<= 41 - static_cast<int>(bits);
    y *= std::int64_t{1} << (41 - bits);
    const auto turn = [&](auto& along, auto& across, auto shifted_along, std::size_t i) {
        if (across > 0) {
            along += across >> i;
            across -= shifted_along;
            angle += static_cast<std::uint32_t>(kAtan[i]);
        } else {
            along -= across >> i;
            across += shifted_along;
            angle -= static_cast<std::uint32_t>(kAtan[i]);
        }
    };
    // Index of the first step in which |y| fits in 32 bits. The rotations lengthen the vector to at
    // most 1.65 * 2^41, and before step i, |y| is at most 2^(1 - i) times this length. In step 12
    // and all later steps, |y| and the terms subtracted from it therefore fit in 32 bits.
    constexpr std::size_t kNarrow = 12;
    for (std::size_t i = 0; i < kNarrow; ++i)
        turn(x, y, x >> i, i);
    auto narrow_y = static_cast<std::int32_t>(y);
    for (std::size_t i = kNarrow; i < kAtan.size(); ++i)
        turn(x, narrow_y, static_cast<std::int32_t>(x >> kNarrow) >> (i - kNarrow), i);
    return static_cast<std::int32_t>(angle);
}

FixedVec unit_q30(std::int32_t angle) {
    constexpr std::int32_t kQuarterTurn = 1 << 30;
    bool opposite = false;
    if (angle > kQuarterTurn || angle < -kQuarterTurn) {
        angle = static_cast<std::int32_t>(static_cast<std::uint32_t>(angle) +
                                          static_cast<std::uint32_t>(kHalfTurn));
        opposite = true;
    }
    std::int32_t x = kCordicGain_q30;
    std::int32_t y = 0;
    for (std::size_t i = 0; i < kAtan.size(); ++i) {
        const std::int32_t x_before = x;
        if (angle >= 0) {
            x -= y >> i;
            y += x_before >> i;
            angle -= kAtan[i];
        } else {
            x += y >> i;
            y -= x_before >> i;
            angle += kAtan[i];
        }
    }
    return opposite ? FixedVec{-x, -y} : FixedVec{x, y};
}

}  // namespace dotpose::core
