// Option ranges: the valid range of each option. If all options are in range, no computation can
// overflow. Options that are safe at any value have no range, for example the lens coefficient k
// (see `bend_q48`).
#pragma once

#include <cstdint>

#include "dotpose/device_options.hpp"

namespace dotpose::core {

/// Calls `is_good(name, value, low, high)` for each option, and stops at the first false result.
/// Returns true if all results are true.
template <typename IsGood>
constexpr bool all_options(const DeviceOptions& options, IsGood is_good) {
    constexpr std::int32_t kFarthestReference_q8 = 16384 * 256;
    constexpr std::int32_t kFarthestLens_q8 = 1024 * 256;
    constexpr std::int32_t kMax = 1 << 20;  // 256 * kMax fits in 32 bits
    const auto is_far_at_most = [&](const char* name, std::int32_t offset, std::int32_t most) {
        return is_good(name, offset, -most, most);
    };
    const auto is_index = [&](const char* name, auto value, auto last) {
        return is_good(name, static_cast<std::int32_t>(value), 0, static_cast<std::int32_t>(last));
    };
    return is_index("code", options.code, CodeVariant::microdots) &&
           is_index("effort", options.effort, Effort::twice) &&
           is_index("decoder", options.decoder, Decoder::all) &&
           is_good("threshold.low_q8", options.threshold.low_q8, 1, 256) &&
           is_good("threshold.high_q8", options.threshold.high_q8, 1, 256) &&
           is_good("threshold.min_contrast", options.threshold.min_contrast, 1, 255) &&
           is_good("blobs.min_area_px", options.blobs.min_area_px, 0, kMax) &&
           is_good("blobs.min_mass_q8", options.blobs.min_mass_q8, 0, 256) &&
           is_good("blobs.max_area_ratio", options.blobs.max_area_ratio, 1, 1024) &&
           is_good("min_contrast", options.min_contrast, 0, 255) &&
           is_good("lattice.min_dots", options.lattice.min_dots, 0, kMax) &&
           is_good("lattice.max_offset_q16", options.lattice.max_offset_q16, 0, 32768) &&
           is_good("integrity.max_p_wrong_log2", options.integrity.max_p_wrong_log2, -kMax, 0) &&
           is_good("integrity.max_bit_error_q8", options.integrity.max_bit_error_q8, 0, 256) &&
           is_good("integrity.bits_per_error", options.integrity.bits_per_error, kMeasuredErrorRate,
                   65536) &&
           is_far_at_most("reference_dx_q8", options.reference_dx_q8, kFarthestReference_q8) &&
           is_far_at_most("reference_dy_q8", options.reference_dy_q8, kFarthestReference_q8) &&
           is_far_at_most("lens.centre_dx_q8", options.lens.centre_dx_q8, kFarthestLens_q8) &&
           is_far_at_most("lens.centre_dy_q8", options.lens.centre_dy_q8, kFarthestLens_q8);
}

}  // namespace dotpose::core
