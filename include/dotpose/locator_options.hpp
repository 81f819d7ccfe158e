/// LocatorOptions: options for a Locator, in millimetres, pixels and ratios. The defaults are
/// suitable for any camera. Ranges are in [brackets]. If a value is out of range, every frame fails
/// with Status::bad_argument, and `bad_option` returns the name of the option.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "dotpose/code.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Options for a Locator. All options apply to every attempt, and also to images that are pushed
/// row by row.
struct LocatorOptions {
    /// Code variant of the sheet. If none is given, the locator detects the variant from all frames
    /// so far. If two code variants explain a frame about equally well, the status is
    /// ambiguous_code.
    std::optional<CodeVariant> code;
    /// Spacing of the printed grid. Used to convert positions to millimetres. Default: 0.508 mm, as
    /// in the paper. Use 0 if the spacing is unknown. [0 to 1000 mm]
    double spacing_mm = 0.508;

    /// Radial distortion k, per px^2: p_u = m + r_d / (1 + k |r_d|^2) (paper, equations 1 and 2).
    /// Negative for barrel distortion. [above -2^-9, below 2^-9]
    double lens_k_per_px2 = 0;
    /// Distortion centre m, relative to the image centre. [-1024 to 1024 px]
    double lens_centre_dx_px = 0;
    double lens_centre_dy_px = 0;
    /// Reference point: the image point whose pose is reported. Relative to the image centre.
    /// [-16384 to 16384 px]
    double reference_dx_px = 0;
    double reference_dy_px = 0;

    /// Maximum accepted bound on the probability that a fix is wrong. Positions with a larger bound
    /// are rejected as not_certain. The value is rounded down to a power of two. [1e-300 to 1]
    double max_p_wrong = 1e-9;
    /// Maximum fraction of bits that may disagree with the code at the position. Applies to each
    /// axis separately. A larger fraction indicates that the frame contains two patterns. [0 to 1]
    double max_bit_errors = 0.18;
    /// Minimum number of bits per misread bit, on average over frames of the same print and camera.
    /// A known number reduces the safety margin, so smaller views are certain. If it is too large,
    /// p_wrong may be too small. 0 (the default) and 1 mean unknown: the error rate is estimated
    /// from each frame alone. With kMeasuredErrorRate, the locator measures the number over all
    /// frames so far. See docs/integrity.md, "Known error rate" and "Measured error rate".
    /// [-1 to 65536]
    int bits_per_error = 0;
    /// Minimum contrast between paper and dots, in grey levels. A frame with less contrast fails
    /// with no_contrast. Increase the value for noisy cameras. With the default of 0, each attempt
    /// applies only its own limit: about 12 grey levels in the first attempt (`kMinDarkness` in
    /// core/detect/tuning.hpp), and 6 in the second attempt (locate/tuning.hpp). [0 to 255]
    int min_contrast = 0;
    /// Minimum number of dots required to search for a grid. A position needs at least 6 x 6 dots.
    /// [0 to 2^20]
    int min_dots = 40;

    Effort effort = Effort::twice;
    Decoder decoder = Decoder::all;
    /// True to store dots, grid and bits in the trace during every attempt. Drawing and calibration
    /// need these results, but storing them takes time.
    bool show_stages = false;

    /// Returns the same options in fixed point. If any option is out of range, the returned options
    /// make every frame fail with Status::bad_argument.
    operator DeviceOptions() const;
};

/// Returns the name of the first option that is out of range, or null if all options are in range.
inline const char* bad_option(const LocatorOptions& options) {
    const auto is_in = [](double value, double low, double high) {
        return value >= low && value <= high;  // false if `value` is NaN
    };
    constexpr double kMaxLens_per_px2 = 0x1p-9 - 0x1p-40;
    constexpr double kMaxLensCentre_px = 1024;
    constexpr double kMaxReference_px = 16384;
    if (options.code.value_or(CodeVariant::anoto) > CodeVariant::microdots) return "code";
    if (!is_in(options.spacing_mm, 0, 1000)) return "spacing_mm";
    if (!is_in(options.lens_k_per_px2, -kMaxLens_per_px2, kMaxLens_per_px2))
        return "lens_k_per_px2";
    if (!is_in(options.lens_centre_dx_px, -kMaxLensCentre_px, kMaxLensCentre_px))
        return "lens_centre_dx_px";
    if (!is_in(options.lens_centre_dy_px, -kMaxLensCentre_px, kMaxLensCentre_px))
        return "lens_centre_dy_px";
    if (!is_in(options.reference_dx_px, -kMaxReference_px, kMaxReference_px))
        return "reference_dx_px";
    if (!is_in(options.reference_dy_px, -kMaxReference_px, kMaxReference_px))
        return "reference_dy_px";
    if (!is_in(options.max_p_wrong, 1e-300, 1)) return "max_p_wrong";
    if (!is_in(options.max_bit_errors, 0, 1)) return "max_bit_errors";
    if (!is_in(options.bits_per_error, kMeasuredErrorRate, 65536)) return "bits_per_error";
    if (!is_in(options.min_contrast, 0, 255)) return "min_contrast";
    if (!is_in(options.min_dots, 0, 1 << 20)) return "min_dots";
    if (options.effort > Effort::twice) return "effort";
    if (options.decoder > Decoder::all) return "decoder";
    return nullptr;
}

// This function is inline, because the object code of the core must not use double precision.
inline LocatorOptions::operator DeviceOptions() const {
    DeviceOptions fixed;
    if (bad_option(*this) != nullptr) {
        fixed.min_contrast = -1;
        return fixed;
    }
    const auto rounded = [](double value) { return static_cast<std::int32_t>(std::lround(value)); };
    fixed.code = code.value_or(CodeVariant::anoto);
    fixed.effort = effort;
    fixed.decoder = decoder;
    fixed.lens = FixedLens::from_k(lens_k_per_px2);
    fixed.lens.centre_dx_q8 = rounded(lens_centre_dx_px * 256);
    fixed.lens.centre_dy_q8 = rounded(lens_centre_dy_px * 256);
    fixed.min_contrast = min_contrast;
    fixed.lattice.min_dots = min_dots;
    fixed.integrity.max_p_wrong_log2 = std::ilogb(max_p_wrong);
    fixed.integrity.max_bit_error_q8 = rounded(max_bit_errors * 256);
    fixed.integrity.bits_per_error = bits_per_error;
    fixed.spacing_nm = rounded(spacing_mm * 1e6);
    fixed.show_stages = show_stages;
    fixed.reference_dx_q8 = rounded(reference_dx_px * 256);
    fixed.reference_dy_q8 = rounded(reference_dy_px * 256);
    return fixed;
}

}  // namespace dotpose

DOTPOSE_END_EXPORT
