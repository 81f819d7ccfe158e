/// Options: options in fixed point, as a DeviceLocator takes them. On desktops, LocatorOptions has
/// them in millimetres, pixels and ratios. Ranges are in [brackets]; a value outside gives
/// Status::bad_argument.
#pragma once

#include <cstdint>

#include "dotpose/code.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Radial distortion, paper eq. 1-2: p_u = m + r_d / (1 + k |r_d|^2), with the distortion centre m.
struct FixedLens {
    /// k in 2^-40 / px^2; negative for barrel distortion. Default 0: none. [any]
    std::int32_t k_q40 = 0;
    /// m in pixels from the image centre, times 256. Default: the image centre itself, as in the
    /// paper; real lenses sit a few pixels off. [-1024 to 1024 px]
    std::int32_t centre_dx_q8 = 0;
    std::int32_t centre_dy_q8 = 0;

    /// Returns the lens of a k in 1/px^2 about the image centre; |k| < 2^-9.
    static constexpr FixedLens from_k(double k_per_px2) {
        constexpr double kQ40 = 1099511627776.0;
        return {static_cast<std::int32_t>(k_per_px2 * kQ40)};
    }
};

/// Options of the thresholds between paper and dots (paper section II-B.1), of devices and of
/// the second attempt.
struct ThresholdOptions {
    /// Share of the local contrast, in 1/256, by which a pixel of a blob is darker than the paper:
    /// the low threshold. A smaller one joins neighbouring dots, a larger
    /// one loses blurred ones. [1 to 256]
    int low_q8 = 120;
    /// Share of the local contrast, in 1/256, by which some pixel of a blob must be darker: the
    /// high threshold. A larger one drops more noise. [1 to 256]
    int high_q8 = 155;
    /// Grey levels of contrast below which an area is blank; raised by `Options::min_contrast`. [1
    /// to 255]
    int min_contrast = 8;
};

/// Options of the choice of dots among dark blobs (paper section II-B.1), in the same attempts.
struct BlobOptions {
    /// Fewest pixels of a dot. 1 keeps salt and pepper noise. [0 to 2^20]
    int min_area_px = 2;
    /// Blobs less dark than this share, in 1/256, of the upper quartile of all blobs are noise. [0
    /// to 256]
    int min_mass_q8 = 64;
    /// Blobs larger than this multiple of the upper quartile of all blobs are graphics. [1 to 1024]
    int max_area_ratio = 5;
};

/// Options of the search for the grid (paper sections II-B.2 and II-B.3). `max_offset_q16` is used
/// in the same attempts.
struct LatticeOptions {
    /// Fewest dots from which a grid is searched; 6 x 6 is the least that can carry a position. [0
    /// to 2^20]
    int min_dots = 40;
    /// Greatest distance of a dot from its intersection, per axis, in 2^-16 spacing; a dot farther
    /// off counts as noise. Nominal is 1/6 spacing. [0 to 32768]
    int max_offset_q16 = 24000;
};

/// Limits beyond which a position is refused as not certain.
struct IntegrityOptions {
    /// Bound, as log2, of the probability of being wrong above which a position is refused; 2^-30 <
    /// 1e-9. [-2^20 to 0]
    int max_p_wrong_log2 = -30;
    /// Greatest share, in 1/256, of the bits read on either axis that may contradict the position;
    /// more mean that the frame shows two patterns. [0 to 256]
    int max_bit_error_q8 = 46;
};

/// How many attempts `locate` makes.
enum class Effort : std::uint8_t {
    device,  ///< one attempt in integers, as a DeviceLocator makes it
    once,    ///< one attempt, as for a frame that comes row by row
    twice,   ///< a frame that could not be read is filtered and read again
};

/// Which dots the position is read from.
enum class Decoder : std::uint8_t {
    window,  ///< the best 8 x 8 symbols, as in the paper: the baseline
    all,     ///< all dots in view
};

/// All options of a Locator.
struct Options {
    CodeVariant code = CodeVariant::anoto;
    Effort effort = Effort::twice;
    Decoder decoder = Decoder::all;
    FixedLens lens;
    ThresholdOptions threshold;
    BlobOptions blobs;
    LatticeOptions lattice;
    IntegrityOptions integrity;

    /// Contrast between paper and dots, in grey levels, below which every attempt gives up with
    /// no_contrast. 0: dots as pale as can be read. [0 to 255]
    int min_contrast = 0;

    /// Greatest number of dots that the first and the tracked attempt fit the pose to, spread
    /// evenly over the frame: accuracy grows with the square root of the number, time with the
    /// number. Default: all dots of a VGA frame at 8 px per spacing. [any; values are limited to
    /// between 64 and what the memory holds]
    int most_dots = 4096;

    /// Spacing of the printed grid in nm, by which a fix is converted to millimetres. Default: that
    /// of the paper. 0: not known. [any]
    std::int32_t spacing_nm = 508'000;

    /// Whether the first and the tracked attempt leave dots, grid and bits in the trace, for
    /// drawing and calibration; that takes time. Other attempts always leave them.
    bool show_stages = false;

    /// The point whose pose is wanted, in pixels from the image centre, times 256. Default: the
    /// image centre itself. [-16384 to 16384 px]
    std::int32_t reference_dx_q8 = 0;
    std::int32_t reference_dy_q8 = 0;
};

}  // namespace dotpose

#pragma GCC visibility pop
