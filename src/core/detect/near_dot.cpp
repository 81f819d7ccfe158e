#include "core/detect/near_dot.hpp"

#include <array>

#include "core/detect/ring.hpp"

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

}  // namespace

bool measure_near_dot(const Tracking& tracking, Vec intersection_q16, NearDot& dot) {
    const int half = tracking.half_px;
    const int u = (intersection_q16.x + 32768) >> 16;
    const int v = (intersection_q16.y + 32768) >> 16;
    const auto inside_u = static_cast<unsigned>(tracking.width_px - 2 * half);
    const auto inside_v = static_cast<unsigned>(tracking.rows_taken - 2 * half);
    if (static_cast<unsigned>(u - half) >= inside_u || static_cast<unsigned>(v - half) >= inside_v)
        return false;
    const RingSquare square = square_around(tracking, u, v);
    const std::int32_t paper = mean_of_corners(square);
    const DarkSums sums = dark_sums(square, paper - ((paper * tracking.cut_q8) >> 8));
    if (sums.mass < tracking.least_mass || sums.mass > tracking.most_mass) return false;
    const Inverse inverse(sums.mass);
    dot.mass = sums.mass;
    dot.from_intersection_q8 = {inverse.quotient_q8(sums.x) + (u * 256 - (intersection_q16.x >> 8)),
                                inverse.quotient_q8(sums.y) +
                                    (v * 256 - (intersection_q16.y >> 8))};
    return true;
}

}  // namespace dotpose::core
