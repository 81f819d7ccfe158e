#include "device/offset_fit.hpp"

#include <algorithm>
#include <bit>

namespace dotpose::core {
namespace {

/// Number of bits to which sums are reduced before two of them are multiplied.
constexpr int kBits = 14;

/// Returns the number of bits by which a number must be shifted right to fit in kBits bits.
int excess_bits(std::int32_t magnitude) {
    return std::max(static_cast<int>(std::bit_width(static_cast<std::uint32_t>(magnitude))) - kBits,
                    0);
}

}  // namespace

bool OffsetFit::correct(PlaneFromImage& plane) const {
    // Moves the origin to the centroid of the dots, truncated to 1/4 px, and subtracts the mean
    // offset. The slopes can then be computed independently of the mean offset.
    const FixedVec mean{p_.x / count_, p_.y / count_};
    const FixedVec rest{p_.x - count_ * mean.x, p_.y - count_ * mean.y};
    const std::int32_t xx = xx_ - mean.x * (p_.x + rest.x);
    const std::int32_t xy = xy_ - mean.x * p_.y - mean.y * rest.x;
    const std::int32_t yy = yy_ - mean.y * (p_.y + rest.y);
    const FixedVec offset_q16{r_.x * 16 / count_, r_.y * 16 / count_};
    const auto moved = [&](FixedVec sum, std::int32_t a_mean, std::int32_t a_rest) {
        return sum - FixedVec{a_mean * r_.x + (a_rest * offset_q16.x >> 4),
                              a_mean * r_.y + (a_rest * offset_q16.y >> 4)};
    };
    const FixedVec of_x = moved(of_x_, mean.x, rest.x);
    const FixedVec of_y = moved(of_y_, mean.y, rest.y);

    const int excess = excess_bits(std::max(xx, yy));
    const std::int32_t a = xx >> excess;
    const std::int32_t b = xy >> excess;
    const std::int32_t c = yy >> excess;
    const std::int32_t determinant = a * c - b * b;
    // The dots are considered collinear if their standard deviation across the best-fitting line is
    // less than about 1/16 of their standard deviation along it.
    if (determinant <= (a + c) * ((a + c) >> 8)) return false;

    const int own = excess_bits(std::max(larger_component(of_x), larger_component(of_y)));
    const std::int32_t divisor = std::max(determinant >> kBits, std::int32_t{1});
    // The unit of the quotients is 2^-12 cells per 1/4 px, times 2^-kBits: 2^-24 cells per px.
    static_assert(12 + kBits - 2 == 24);
    const auto slope_q24 = [&](std::int32_t numerator) {
        return numerator / divisor * (1 << own) >> excess;
    };
    const auto slopes = [&](std::int32_t x, std::int32_t y) {
        x >>= own;
        y >>= own;
        return FixedVec{slope_q24(x * c - y * b), slope_q24(y * a - x * b)};
    };
    const FixedVec of_i = slopes(of_x.x, of_y.x);
    const FixedVec of_j = slopes(of_x.y, of_y.y);
    const auto at_centre_q16 = [&](std::int32_t there_q16, FixedVec slope) {
        // Adds half a unit, because `add` rounds each offset down by half a unit on average.
        return there_q16 + 8 - ((slope.x * mean.x + slope.y * mean.y) >> 10);
    };
    plane.at_centre_q16 = plane.at_centre_q16 - FixedVec{at_centre_q16(offset_q16.x, of_i),
                                                         at_centre_q16(offset_q16.y, of_j)};
    plane.du_q24 = plane.du_q24 - FixedVec{of_i.x, of_j.x};
    plane.dv_q24 = plane.dv_q24 - FixedVec{of_i.y, of_j.y};
    return true;
}

}  // namespace dotpose::core
