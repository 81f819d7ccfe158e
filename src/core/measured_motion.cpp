#include "dotpose/measured_motion.hpp"

#include <cmath>

namespace dotpose {

bool MeasuredMotion::is_usable() const {
    constexpr float kMax = 1e6F;
    const auto is_size = [](float value) { return value >= 0 && value < kMax; };
    return is_size(std::fabs(right_mm)) && is_size(std::fabs(down_mm)) &&
           is_size(std::fabs(turn_rad)) && is_size(sigma_mm) && is_size(sigma_rad);
}

MeasuredMotion followed_by(const MeasuredMotion& first, const MeasuredMotion& second) {
    const float c = std::cos(first.turn_rad);
    const float s = std::sin(first.turn_rad);
    // Standard deviation of the endpoint due to the error of the first rotation, which turns the
    // second displacement by the same angle.
    const float lever_mm = first.sigma_rad * std::hypot(second.right_mm, second.down_mm);
    return {.right_mm = first.right_mm + c * second.right_mm - s * second.down_mm,
            .down_mm = first.down_mm + s * second.right_mm + c * second.down_mm,
            .turn_rad = first.turn_rad + second.turn_rad,
            .sigma_mm = std::hypot(std::hypot(first.sigma_mm, second.sigma_mm), lever_mm),
            .sigma_rad = std::hypot(first.sigma_rad, second.sigma_rad)};
}

}  // namespace dotpose
