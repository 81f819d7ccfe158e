#include "locate/after_motion.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::core {
namespace {

/// Maximum predicted motion, in spacings. Larger motions are not predicted, because fixed-point
/// coordinates could overflow.
constexpr float kMaxMotion = 2048;
/// Minimum standard deviation of a predicted position, in 2^-16 spacings. Accounts for the error in
/// the last plane, which is not part of `MeasuredMotion::sigma_mm`.
constexpr float kMinSigma_q16 = 65536.0F / 32;

}  // namespace

Prediction after(const MeasuredMotion& motion, const Fix& last, const DeviceOptions& options) {
    constexpr float kBam_per_rad = 683565275.6F;  // 2^31 / pi
    const Prediction same_place = Prediction::like(last);
    const float theta_rad = static_cast<float>(last.theta_bam) / kBam_per_rad;
    const float c = std::cos(theta_rad);
    const float s = std::sin(theta_rad);
    const float right = motion.right_mm / spacing_mm(options);
    const float down = motion.down_mm / spacing_mm(options);
    if (!(std::hypot(right, down) < kMaxMotion)) return same_place;
    const auto q16 = [](float spacings) { return static_cast<std::int32_t>(spacings * 65536); };
    const float turn_rad = std::remainder(motion.turn_rad, 6.2831853F);
    const auto turn_bam = static_cast<std::int64_t>(turn_rad * kBam_per_rad);
    const FixedVec centre_q8 = last.pattern_from_image.centre_q8;
    Prediction next =
        moved(same_place, options.code, {q16(c * right - s * down), q16(s * right + c * down)},
              static_cast<std::int32_t>(static_cast<std::uint32_t>(turn_bam)),
              {centre_q8.x + options.reference_dx_q8, centre_q8.y + options.reference_dy_q8});
    const float sigma_q16 = 65536 * motion.sigma_mm / spacing_mm(options);
    next.sigma_q16 = static_cast<std::int32_t>(
        std::clamp(sigma_q16, kMinSigma_q16, static_cast<float>(same_place.sigma_q16)));
    return next;
}

}  // namespace dotpose::core
