/// Device options: the options of a DeviceLocator, in fixed point. A Locator accepts them, too.
/// Desktop programs usually use LocatorOptions, with values in millimetres, pixels and ratios.
/// Ranges are in [brackets]. If a value is outside its range, every frame gets
/// Status::bad_argument.
#pragma once

#include <cstdint>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Radial distortion, paper eq. 1-2: p_u = m + r_d / (1 + k |r_d|^2). p_u is the undistorted point,
/// m is the distortion centre, and r_d is the vector from m to the image point.
struct FixedLens {
    /// k in units of 2^-40 / px^2; negative for barrel distortion. Default 0: no distortion. [any]
    std::int32_t k_q40 = 0;
    /// m relative to the image centre, in px times 256. Default: the image centre, as in the paper.
    /// In real lenses, m differs from the image centre by a few pixels. [-1024 to 1024 px]
    std::int32_t centre_dx_q8 = 0;
    std::int32_t centre_dy_q8 = 0;

    /// Returns the lens with distortion k, in 1/px^2, about the image centre. |k| must be less than
    /// 2^-9.
    static constexpr FixedLens from_k(double k_per_px2) {
        constexpr double kQ40 = 1099511627776.0;
        return {static_cast<std::int32_t>(k_per_px2 * kQ40)};
    }
};

/// Options of the thresholds between paper and dots (paper section II-B.1). Used by devices and by
/// the second attempt. The second attempt reduces the thresholds, because it filters the image
/// first.
struct ThresholdOptions {
    /// Low threshold: minimum contrast between the paper and every pixel of a blob, as a fraction
    /// of the local contrast, in 1/256. Smaller values merge neighbouring dots. Larger values lose
    /// blurred dots. [1 to 256]
    int low_q8 = 120;
    /// High threshold: minimum contrast between the paper and the darkest pixel of a blob, as a
    /// fraction of the local contrast, in 1/256. Larger values reject more noise. [1 to 256]
    int high_q8 = 155;
    /// Contrast, in grey levels, below which a tile of the image counts as blank. The effective
    /// limit is clamp(c / 6, min_contrast, 2 * min_contrast), where c is the largest contrast in
    /// the frame so far. On devices, min_contrast is the larger of this option and
    /// `DeviceOptions::min_contrast`. [1 to 255]
    int min_contrast = 8;
};

/// Options of the selection of dots among dark blobs (paper section II-B.1). Used by devices and by
/// the second attempt.
struct BlobOptions {
    /// Minimum number of pixels of a dot. A value of 1 does not remove salt-and-pepper noise. [0 to
    /// 2^20]
    int min_area_px = 2;
    /// Minimum mass (summed darkness) of a dot, as a fraction of the upper quartile of the masses
    /// of all blobs, in 1/256. Paler blobs are noise. [0 to 256]
    int min_mass_q8 = 64;
    /// Maximum area of a dot, as a multiple of the upper quartile of the areas of all blobs. Larger
    /// blobs are graphics. [1 to 1024]
    int max_area_ratio = 5;
};

/// Options of the search for the grid (paper sections II-B.2 and II-B.3). Only devices and the
/// second attempt use `max_offset_q16`.
struct LatticeOptions {
    /// Minimum number of dots required to search for a grid. A position needs at least 6 x 6 dots.
    /// [0 to 2^20]
    int min_dots = 40;
    /// Maximum distance of a dot from its intersection, along each axis, in units of 2^-16
    /// spacings. Dots at a larger distance count as noise. The nominal distance is 1/6 spacing. [0
    /// to 32768]
    int max_offset_q16 = 24000;
};

/// Limits beyond which a position is refused as not certain.
struct IntegrityOptions {
    /// Maximum log2 of the upper bound on the probability that a fix is wrong. A position with a
    /// larger bound is refused. The default is slightly below 1e-9. [-2^20 to 0]
    int max_p_wrong_log2 = -30;
    /// Maximum fraction, in 1/256, of the bits read on either axis that may contradict the
    /// position. A larger fraction indicates that the frame contains two patterns. [0 to 256]
    int max_bit_error_q8 = 46;
};

/// The attempts that `locate` makes.
enum class Effort : std::uint8_t {
    device,  ///< one attempt in integer arithmetic, as on a DeviceLocator
    once,    ///< the tracked attempt, if there is a prediction, and the first attempt
    twice,   ///< also the second attempt, on the filtered image, if the first attempt fails or its
             ///< residuals are large
};

/// Dots from which the position is read.
enum class Decoder : std::uint8_t {
    /// The clearest window of 8 x 8 symbols, as in the paper. Intended for comparison. `locate`
    /// omits the first attempt, and makes the second attempt with every Effort except `device`.
    window,
    all,  ///< all dots in view
};

/// All options of a DeviceLocator or Locator, in fixed point.
struct DeviceOptions {
    CodeVariant code = CodeVariant::anoto;
    Effort effort = Effort::twice;
    Decoder decoder = Decoder::all;
    FixedLens lens;
    ThresholdOptions threshold;
    BlobOptions blobs;
    LatticeOptions lattice;
    IntegrityOptions integrity;

    /// Minimum contrast between paper and dots, in grey levels. A frame with less contrast gets the
    /// status no_contrast, or not_tracked if a DeviceLocator only tracks the frame. Default 0: any
    /// contrast that can be read. [0 to 255]
    int min_contrast = 0;

    /// Maximum number of dots to which the first and the tracked attempt fit the pose, spread
    /// evenly over the frame. The error is proportional to 1 / sqrt(max_dots), and the time is
    /// proportional to max_dots. The default includes all dots of a VGA frame at 9 px per spacing.
    /// [any; clamped to the range from 64 to the capacity of the memory]
    int max_dots = 4096;

    /// Spacing of the printed grid in nm, which converts a fix to millimetres. Default: 0.508 mm,
    /// as in the paper. 0 means that the spacing is not known. [any]
    std::int32_t spacing_nm = 508'000;

    /// True if the first and the tracked attempt store dots, grid and bits in the trace, for
    /// drawing and calibration. Storing them takes time. The other attempts always store dots, grid
    /// and bits.
    bool show_stages = false;

    /// Reference point: the image point whose pose is reported, relative to the image centre, in px
    /// times 256. Default: the image centre. [-16384 to 16384 px]
    std::int32_t reference_dx_q8 = 0;
    std::int32_t reference_dy_q8 = 0;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
