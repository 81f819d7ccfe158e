// Patch memory: storage for a part of the image and its dots, and for the measured dots of a frame.
// Devices do not use patch memory.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace dotpose::core {

/// Dots found in a patch. Their coordinates are in image pixels, relative to the middle of the
/// patch or to an origin chosen by `move_origin_to_densest`.
struct PatchDots {
    static constexpr int kMax = 2048;
    int count = 0;
    // Padded to a multiple of the vector length. The padding elements are far outside the patch.
    alignas(64) std::array<float, kMax + 16> x;
    alignas(64) std::array<float, kMax + 16> y;
};

/// A part of an image with a margin on all sides, downscaled by the factor `scale`.
struct Patch {
    static constexpr int kMaxWidth_px = 256;
    static constexpr int kMaxHeight_px = 192;
    static constexpr int kMarginX_px = 32;
    static constexpr int kMarginY_px = 8;
    static constexpr int kTileWidth_px = 16;
    static constexpr int kTileHeight_px = 8;
    static constexpr int kMaxStride = kMaxWidth_px + 2 * kMarginX_px;
    static constexpr int kMaxPixels = (kMaxHeight_px + 2 * kMarginY_px) * kMaxStride;
    static constexpr int kTilesPerRow = kMaxWidth_px / kTileWidth_px;
    static constexpr int kTiles = kTilesPerRow * kMaxHeight_px / kTileHeight_px;
    static constexpr int kStrips = kMaxWidth_px / 32;

    /// Minimum side of a patch if no sheets are known: 8 dots at a spacing of 6 px.
    static constexpr int kMinSide_px = 48;

    int min_side_px = kMinSide_px;
    int left_px = 0;  ///< left edge of the patch, in image pixels
    int top_px = 0;
    int scale = 1;  ///< side of a patch pixel, in image pixels
    int width_px = 0;
    int height_px = 0;
    int stride = 0;
    /// Contrast of a typical dot after smoothing, in 1/256 of the paper level.
    int dot_contrast_q8 = 0;
    alignas(64) std::array<std::uint8_t, kMaxPixels> pixels;
    alignas(64) std::array<std::uint8_t, kMaxPixels> smoothed;
    alignas(64) std::array<std::uint8_t, kTiles> brightest;
    alignas(64) std::array<std::uint8_t, kTiles> darkness;  ///< 255 minus each tile's darkest level
    alignas(64) std::array<std::uint8_t, kTiles> thresholds;
    PatchDots dots;

    std::uint8_t* row(std::array<std::uint8_t, kMaxPixels>& of, int v) {
        return of.data() + (v + kMarginY_px) * stride + kMarginX_px;
    }
};

/// Measured dots and their cells in the pattern. The arrays are padded to a multiple of the vector
/// length. After a measurement, `x` is kNoDot_px in the padding.
struct MeasuredDots {
    int count = 0;
    std::span<float> column;  ///< column of the cell, in coordinates of the current plane
    std::span<float> row;
    /// Bits of the cell in the code: x bit + 2 * y bit.
    std::span<std::int32_t> bits;
    /// Window centre, in px relative to the first pixel of the image.
    std::span<std::int32_t> window_u;
    std::span<std::int32_t> window_v;
    /// Summed darkness in the window, or the contrast of a directly sampled dot.
    std::span<std::int32_t> mass;
    /// First moment along u: darkness times distance from the window centre in px, summed over the
    /// window.
    std::span<std::int32_t> sum_u;
    std::span<std::int32_t> sum_v;  ///< first moment along v
    std::span<std::int32_t> paper;  ///< paper level around the dot, in grey levels
    /// Measured centre after undistortion, in px relative to the plane centre. Before the
    /// measurement, `x` and `y` contain the predicted image point. After it, `x` is kNoDot_px if no
    /// dot was found.
    std::span<float> x;
    std::span<float> y;

    int capacity() const { return static_cast<int>(column.size()) - 8; }
};

/// Coordinate of a missing dot, far outside every image.
inline constexpr float kNoDot_px = 1e6F;

}  // namespace dotpose::core
