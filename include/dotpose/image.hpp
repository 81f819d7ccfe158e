/// Non-owning view of an 8-bit grey image.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dotpose/export.hpp"
#include "dotpose/language.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Minimum width and height, in pixels, for locating an image.
inline constexpr int kMinFrameSide_px = 64;
/// Minimum width and height, in pixels, for locating an image on known sheets (Locator::set_known).
inline constexpr int kMinKnownFrameSide_px = 24;
/// Maximum image width and height, in pixels.
inline constexpr int kMaxFrameSide_px = 4096;

/// Grey image with dark dots on light paper. Row `v` starts at `pixels + v * stride_bytes`.
/// Grey level 0 is black.
struct ImageView {
    const std::uint8_t* pixels = nullptr;
    int width_px = 0;
    int height_px = 0;
    std::ptrdiff_t stride_bytes = 0;

    const std::uint8_t* row(int v) const { return pixels + v * stride_bytes; }
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
