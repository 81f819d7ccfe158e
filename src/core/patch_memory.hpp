// Patch: what the desktop's attempts keep of a part of the image, and of the dots they measure.
// Unstable, like stages.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace dotpose::core {

/// Dots in a patch, from its middle, in px of the image.
struct PatchDots {
    static constexpr int kMost = 2048;
    int count = 0;
    // Rounded up to whole vectors, the rest being far away.
    alignas(64) std::array<float, kMost + 16> x;
    alignas(64) std::array<float, kMost + 16> y;
};

/// A part of an image, reduced by `scale`, with a margin around it.
struct Patch {
    static constexpr int kMostWidth_px = 256;
    static constexpr int kMostHeight_px = 192;
    static constexpr int kMarginX_px = 32;
    static constexpr int kMarginY_px = 8;
    static constexpr int kTileWidth_px = 16;
    static constexpr int kTileHeight_px = 8;
    static constexpr int kMostStride = kMostWidth_px + 2 * kMarginX_px;
    static constexpr int kMostPixels = (kMostHeight_px + 2 * kMarginY_px) * kMostStride;
    static constexpr int kTilesPerRow = kMostWidth_px / kTileWidth_px;
    static constexpr int kTiles = kTilesPerRow * kMostHeight_px / kTileHeight_px;
    static constexpr int kStrips = kMostWidth_px / 32;

    int left_px = 0;  ///< of the image
    int top_px = 0;
    int scale = 1;  ///< px of the image, both ways, that make one of the patch
    int width_px = 0;
    int height_px = 0;
    int stride = 0;
    int depth_q8 = 0;  ///< how much darker than paper a typical dot is, smoothed, in 1/256
    alignas(64) std::array<std::uint8_t, kMostPixels> pixels;
    alignas(64) std::array<std::uint8_t, kMostPixels> smoothed;
    alignas(64) std::array<std::uint8_t, kTiles> brightest;
    alignas(64) std::array<std::uint8_t, kTiles> darkness;  ///< 255 less the darkest level
    alignas(64) std::array<std::uint8_t, kTiles> thresholds;
    PatchDots dots;

    std::uint8_t* row(std::array<std::uint8_t, kMostPixels>& of, int v) {
        return of.data() + (v + kMarginY_px) * stride + kMarginX_px;
    }
};

/// Dots by the cells of the pattern that they stand for; whole vectors, the rest being far away.
struct MeasuredDots {
    int count = 0;
    std::span<float> column;  ///< of the pattern, counted as its plane does
    std::span<float> row;
    std::span<std::int32_t> bits;  ///< that the code has there: the x bit, and the y bit times 2
    std::span<std::int32_t> window_u;  ///< px, the middle of the window
    std::span<std::int32_t> window_v;
    std::span<std::int32_t> mass;   ///< sums over the window: of darkness,
    std::span<std::int32_t> sum_u;  ///< times px from its left
    std::span<std::int32_t> sum_v;  ///< times px from its top
    std::span<std::int32_t> paper;  ///< level around the dot
    /// As measured, px from the plane's centre, without the lens; far away if none. Before that,
    /// where it is expected in the image.
    std::span<float> x;
    std::span<float> y;

    int capacity() const { return static_cast<int>(column.size()) - 8; }
};

/// Far away.
inline constexpr float kNoDot_px = 1e6F;

}  // namespace dotpose::core
