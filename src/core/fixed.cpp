#include "core/fixed.hpp"

#include <array>

namespace dotpose::core {
namespace {

/// CORDIC (Volder 1959): atan(2^-i) as binary angles, i = 0..29.
constexpr std::array<std::int32_t, 30> kAtan{
    536870912, 316933406, 167458907, 85004756, 42667331, 21354465, 10679838, 5340245,
    2670163,   1335087,   667544,    333772,   166886,   83443,    41722,    20861,
    10430,     5215,      2608,      1304,     652,      326,      163,      81,
    41,        20,        10,        5,        3,        1};

/// Product of cos(atan(2^-i)), times 2^30: what the rotations below lengthen a vector by, inverted.
constexpr std::int32_t kCordicGain_q30 = 652032874;

constexpr std::int32_t kHalfTurn = INT32_MIN;

std::int32_t of_rank(std::size_t rank, std::span<std::int32_t> values) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

}  // namespace

std::int64_t log2_q16(std::uint32_t n) {
    // Bit by bit: squaring doubles the logarithm.
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

std::int32_t angle_bam(Vec direction) {
    std::int64_t x = direction.x;
    std::int64_t y = direction.y;
    if (x == 0 && y == 0) return 0;
    std::uint32_t angle = 0;
    if (x < 0) {
        x = -x;
        y = -y;
        angle = static_cast<std::uint32_t>(kHalfTurn);
    }
    while (x + magnitude(y) < (std::int64_t{1} << 40)) {
        x *= 2;
        y *= 2;
    }
    for (std::size_t i = 0; i < kAtan.size(); ++i) {
        const std::int64_t x_before = x;
        if (y > 0) {
            x += y >> i;
            y -= x_before >> i;
            angle += static_cast<std::uint32_t>(kAtan[i]);
        } else {
            x -= y >> i;
            y += x_before >> i;
            angle -= static_cast<std::uint32_t>(kAtan[i]);
        }
    }
    return static_cast<std::int32_t>(angle);
}

Vec unit_q30(std::int32_t angle) {
    constexpr std::int32_t kQuarterTurn = 1 << 30;
    bool opposite = false;
    if (angle > kQuarterTurn || angle < -kQuarterTurn) {
        angle = static_cast<std::int32_t>(static_cast<std::uint32_t>(angle) +
                                          static_cast<std::uint32_t>(kHalfTurn));
        opposite = true;
    }
    std::int64_t x = kCordicGain_q30;
    std::int64_t y = 0;
    for (std::size_t i = 0; i < kAtan.size(); ++i) {
        const std::int64_t x_before = x;
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
    const Vec unit{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
    return opposite ? -unit : unit;
}

}  // namespace dotpose::core
