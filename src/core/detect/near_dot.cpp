#include "core/detect/near_dot.hpp"

#include <algorithm>
#include <array>

#include "core/detect/ring.hpp"
#include "core/fixed.hpp"
#include "core/kernels/portable/dark_sums.hpp"

namespace dotpose::core {
namespace {

/// 2^21 / n for n from 256 to 511: processors without a divider multiply.
constexpr auto kInverses_q21 = [] {
    std::array<std::uint16_t, 256> all{};
    for (std::size_t n = 0; n < all.size(); ++n)
        all[n] = static_cast<std::uint16_t>(((1U << 21) + 128 + n / 2) / (256 + n));
    return all;
}();

/// Divides by a mass, from 16 to 2^16, to half a percent.
class Inverse {
  public:
    explicit Inverse(std::int32_t mass) {
        while (mass >= 512) {
            mass >>= 1;
            ++shift_;
        }
        while (mass < 256) {
            mass <<= 1;
            --shift_;
        }
        inverse_q21_ = kInverses_q21[static_cast<std::size_t>(mass - 256)];
    }
    /// sum / mass in 2^-8, of a sum at most 8 times the mass.
    std::int32_t quotient_q8(std::int32_t sum) const {
        // The sum has the bits of the mass, 9, and 3 more.
        const std::int32_t n = shift_ > 3 ? sum >> (shift_ - 3) : sum * (1 << (3 - shift_));
        return (n * inverse_q21_) >> 16;
    }

  private:
    int shift_ = 0;
    std::int32_t inverse_q21_ = 0;
};

/// The pixel next to a place.
Vec pixel_at(Vec place_q16) {
    return {(place_q16.x + 32768) >> 16, (place_q16.y + 32768) >> 16};
}

template <int Half>
DarkSums sums_around(const Tracking& tracking, Vec pixel, std::int32_t level) {
    const std::int32_t bytes = tracking.ring_bytes;
    const int left = pixel.x - Half;
    const RingRows ring{tracking.rows.data() + left + bytes, bytes, tracking.stride_px};
    return dark_sums<Half>(kept_row(tracking, pixel.y - Half) + left, ring, level);
}

/// Of the four pixels about a place.
std::int32_t sum_of_four(const Tracking& tracking, Vec place_q16) {
    const std::uint8_t* const above = kept_row(tracking, place_q16.y >> 16) + (place_q16.x >> 16);
    const std::uint8_t* below = above + tracking.stride_px;
    if (below >= tracking.rows.data() + tracking.ring_bytes) below -= tracking.ring_bytes;
    return above[0] + above[1] + below[0] + below[1];
}

}  // namespace

std::int32_t paper_around(const Tracking& tracking, Vec intersection_q16) {
    const int half = tracking.half_px;
    const Vec at = pixel_at(intersection_q16);
    const auto inside_u = static_cast<unsigned>(tracking.width_px - 2 * half);
    const auto inside_v = static_cast<unsigned>(tracking.rows_taken - 2 * half);
    if (static_cast<unsigned>(at.x - half) >= inside_u ||
        static_cast<unsigned>(at.y - half) >= inside_v)
        return 0;
    const std::uint8_t* const top = kept_row(tracking, at.y - half) + at.x - half;
    const std::uint8_t* const bottom = kept_row(tracking, at.y + half) + at.x - half;
    return (top[0] + top[2 * half] + bottom[0] + bottom[2 * half]) >> 2;
}

Reading read_symbol(const Tracking& tracking, Vec intersection_q16, std::int32_t paper,
                    std::int32_t depth) {
    std::int32_t darkest = INT32_MAX;
    std::int32_t second = INT32_MAX;
    std::size_t symbol = 0;
    for (std::size_t s = 0; s < tracking.displaced_q16.size(); ++s) {
        const std::int32_t sum =
            sum_of_four(tracking, intersection_q16 + tracking.displaced_q16[s]);
        if (sum < darkest) {
            second = darkest;
            darkest = sum;
            symbol = s;
        } else {
            second = std::min(second, sum);
        }
    }
    // Dots lack some 6 depths in four pixels, and 2 of them at the places beside their own.
    const bool is_dot = 4 * paper - darkest >= 2 * depth;
    return {static_cast<Symbol>(symbol), is_dot && second - darkest >= depth};
}

bool measure_dot(const Tracking& tracking, Vec place_q16, int half, std::int32_t level,
                 NearDot& dot) {
    const Vec pixel = pixel_at(place_q16);
    DarkSums sums;
    switch (half) {
        case 2:
            sums = sums_around<2>(tracking, pixel, level);
            break;
        case 3:
            sums = sums_around<3>(tracking, pixel, level);
            break;
        case 4:
            sums = sums_around<4>(tracking, pixel, level);
            break;
        case 5:
            sums = sums_around<5>(tracking, pixel, level);
            break;
        default:
            sums = sums_around<kMostHalf_px>(tracking, pixel, level);
            break;
    }
    if (sums.mass < tracking.least_mass || sums.mass > tracking.most_mass) return false;
    const Inverse inverse(sums.mass);
    dot.mass = sums.mass;
    dot.off_q8 = {inverse.quotient_q8(sums.x) + pixel.x * 256 - (place_q16.x >> 8),
                  inverse.quotient_q8(sums.y) + pixel.y * 256 - (place_q16.y >> 8)};
    return true;
}

}  // namespace dotpose::core
