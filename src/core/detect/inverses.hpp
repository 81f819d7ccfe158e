// Inverses: division by multiplication, for processors without a divide instruction.
#pragma once

#include <cstdint>

#include "core/math/tabled.hpp"

namespace dotpose::core {

/// Returns 1 / (n + 1) in units of 2^-22, rounded down.
constexpr std::uint32_t inverse_q22(std::uint32_t n) {
    return (1U << 22) / (n + 1);
}

/// Divides sums by a mass between 16 and 2^16. The inverse of the mass has a relative error of at
/// most 1 %.
class Inverse {
  public:
    explicit Inverse(std::int32_t mass) {
        for (; mass > 256; mass >>= 1)
            ++shift_;
        for (; mass <= 128; mass <<= 1)
            --shift_;
        inverse_q22_ = static_cast<std::int32_t>(
            tabled<inverse_q22, 256>(static_cast<std::uint32_t>(mass - 1)));
    }
    /// Returns sum / mass in units of 2^-8. Requires |sum| <= 8 mass.
    std::int32_t quotient_q8(std::int32_t sum) const {
        // The product fits in 32 bits. The shifted mass is at most 2^8, so n is at most 8 * 2^8 in
        // magnitude. `inverse_q22_` is at most 2^15.
        const std::int32_t n = shift_ > 0 ? sum >> shift_ : sum * (1 << -shift_);
        return (n * inverse_q22_) >> 14;
    }

  private:
    int shift_ = 0;
    std::int32_t inverse_q22_ = 0;
};

}  // namespace dotpose::core
