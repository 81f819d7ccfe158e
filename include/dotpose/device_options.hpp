/// Device options: fixed-point options for a DeviceLocator. A Locator also accepts these options.
/// Desktop programs usually use LocatorOptions instead, with values in millimetres, pixels and
/// ratios. Ranges are in [brackets]. If a value is out of range, every frame fails with
/// Status::bad_argument.
#pragma once

#include <cstdint>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Radial lens distortion (paper, equations 1 and 2): p_u = m + r_d / (1 + k |r_d|^2). p_u is the
/// undistorted point, m is the distortion centre, and r_d is the vector from m to the image point.
struct FixedLens {
    /// Coefficient k, in units of 2^-40 / px^2. Negative for barrel distortion. The default of 0
    /// means no distortion. [any]
    std::int32_t k_q40 = 0;
    /// Distortion centre m relative to the image centre, in units of 2^-8 px. Default: the image
    /// centre, as in the paper. In a real camera, the two centres are typically a few pixels apart.
    /// [-1024 to 1024 px]
    std::int32_t centre_dx_q8 = 0;
    std::int32_t centre_dy_q8 = 0;

    /// Returns a lens with distortion k, in 1/px^2, centred on the image. |k| must be less than
    /// 2^-9.
    static constexpr FixedLens from_k(double k_per_px2) {
        constexpr double kQ40 = 1099511627776.0;
        return {static_cast<std::int32_t>(k_per_px2 * kQ40)};
    }
};

/// Thresholds that separate dots from paper (paper, section II-B.1). A DeviceLocator uses these
/// values. The second attempt (see Effort) filters the image first, and therefore uses lower
/// thresholds, which it derives from these values.
struct ThresholdOptions {
    /// Low threshold, in 1/256 of the local contrast. All pixels in a blob must be at least this
    /// much darker than the paper. Smaller values merge neighbouring dots. Larger values lose
    /// blurred dots. [1 to 256]
    int low_q8 = 120;
    /// High threshold, in 1/256 of the local contrast. The darkest pixel of a blob must be at least
    /// this much darker than the paper. Larger values reject more noise. [1 to 256]
    int high_q8 = 155;
    /// Minimum contrast of an image tile with dots, in grey levels. A tile is treated as blank if
    /// its contrast is below clamp(c / 6, min_contrast, 2 * min_contrast), where c is the largest
    /// contrast of a tile in the frame so far. A DeviceLocator uses this option or
    /// `DeviceOptions::min_contrast`, whichever is larger. [1 to 255]
    int min_contrast = 8;
};

/// Criteria that distinguish dots from other dark blobs (paper, section II-B.1). Used by a
/// DeviceLocator and in the second attempt.
struct BlobOptions {
    /// Minimum area of a dot, in pixels. With a value of 1 or less, salt-and-pepper noise is not
    /// removed. [0 to 2^20]
    int min_area_px = 2;
    /// Minimum mass (summed darkness) of a dot, in 1/256 of the upper quartile of all blob masses.
    /// Blobs with less mass are noise. [0 to 256]
    int min_mass_q8 = 64;
    /// Maximum area of a dot, as a multiple of the upper quartile of all blob areas. Larger blobs
    /// are graphics. [1 to 1024]
    int max_area_ratio = 5;
};

/// Options for finding the grid (paper, sections II-B.2 and II-B.3).
struct LatticeOptions {
    /// Minimum number of dots required to search for a grid. A position needs at least 6 x 6 dots.
    /// [0 to 2^20]
    int min_dots = 40;
    /// Maximum distance between a dot and its intersection along each axis, in units of 2^-16
    /// spacings. Dots farther away are treated as noise. The nominal distance is 1/6 spacing. Used
    /// only by a DeviceLocator and in the second attempt. [0 to 32768]
    int max_offset_q16 = 24000;
};

/// Value of `bits_per_error`: a Locator measures the error rate over all its frames so far.
inline constexpr int kMeasuredErrorRate = -1;

/// Criteria for accepting a position. Positions that do not meet them are rejected as not_certain.
struct IntegrityOptions {
    /// Maximum accepted bound on the probability that a fix is wrong, as log2. The default is
    /// slightly below 1e-9. [-2^20 to 0]
    int max_p_wrong_log2 = -30;
    /// Maximum fraction of bits that may disagree with the code at the position, in 1/256. Applies
    /// to each axis separately. A larger fraction indicates that the frame contains two patterns.
    /// [0 to 256]
    int max_bit_error_q8 = 46;
    /// Minimum number of bits per misread bit, on average over frames of the same print and camera.
    /// A known number reduces the safety margin, so smaller views are certain. If it is too large,
    /// p_wrong may be too small. 0 (the default) and 1 mean unknown: the error rate is estimated
    /// from each frame alone. With kMeasuredErrorRate, a Locator measures the number over its
    /// frames, and a DeviceLocator treats it as unknown. See docs/integrity.md, "Known error rate"
    /// and "Measured error rate". [-1 to 65536]
    int bits_per_error = 0;
};

/// Attempts that `locate` makes.
enum class Effort : std::uint8_t {
    device,  ///< one attempt in integer arithmetic, like that of a DeviceLocator
    once,    ///< the tracked attempt if there is a prediction, then the first attempt if necessary
    /// The attempts of `once`, and then a second attempt on the filtered image if the first attempt
    /// fails or its fix has large residuals.
    twice,
};

/// Selects the dots from which the position is decoded.
enum class Decoder : std::uint8_t {
    /// The clearest window of 8 x 8 symbols, as in the paper. Intended for comparison with the
    /// paper. Skips the first attempt in favour of the second, even with Effort::once. Has no
    /// effect with Effort::device.
    window,
    all,  ///< all dots in view
};

/// All options for a DeviceLocator or Locator, in fixed point.
struct DeviceOptions {
    CodeVariant code = CodeVariant::anoto;
    Effort effort = Effort::twice;
    Decoder decoder = Decoder::all;
    FixedLens lens;
    ThresholdOptions threshold;
    BlobOptions blobs;
    LatticeOptions lattice;
    IntegrityOptions integrity;

    /// Minimum contrast between paper and dots, in grey levels. A frame with less contrast fails
    /// with no_contrast. On a DeviceLocator, a frame that was begun with a prediction fails with
    /// not_tracked instead. With the default of 0, each attempt applies only its own limit (see
    /// LocatorOptions). [0 to 255]
    int min_contrast = 0;

    /// Maximum number of dots in the pose fit of the first and the tracked attempt. If more dots
    /// are in view, the fit uses a subset that is spread evenly over the frame. The pose error then
    /// scales with 1 / sqrt(max_dots), and the time of the fit with max_dots. The default covers
    /// all dots of a VGA frame at 9 px per spacing. [any; clamped to the range from 64 to the
    /// capacity of the memory]
    int max_dots = 4096;

    /// Spacing of the printed grid, in nm. Used to convert positions to millimetres. Default: 0.508
    /// mm, as in the paper. Use 0 if the spacing is unknown. [any]
    std::int32_t spacing_nm = 508'000;

    /// True to store dots, grid and bits in the trace during the first and the tracked attempt.
    /// Drawing and calibration need these results, but storing them takes time. The other attempts
    /// always store them.
    bool show_stages = false;

    /// Reference point: the image point whose pose is reported. Relative to the image centre, in
    /// units of 2^-8 px. Default: the image centre. [-16384 to 16384 px]
    std::int32_t reference_dx_q8 = 0;
    std::int32_t reference_dy_q8 = 0;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
