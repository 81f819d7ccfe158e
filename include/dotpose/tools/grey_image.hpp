/// An 8-bit grey image that owns its pixels, for tools. The core uses only `ImageView`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/image.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Grey image. The levels are stored row by row from the top, without padding: pixel (u, v) is
/// `pixels[v * width_px + u]`. Grey level 0 is black.
struct GreyImage {
    std::vector<std::uint8_t> pixels;
    int width_px = 0;
    int height_px = 0;

    /// Returns a view that is valid until `pixels` is resized or destroyed.
    ImageView view() const {
        return {pixels.data(), width_px, height_px, static_cast<std::ptrdiff_t>(width_px)};
    }
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
