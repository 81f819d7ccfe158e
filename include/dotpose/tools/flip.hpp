/// Flips images left to right.
#pragma once

#include <algorithm>
#include <cstddef>

#include "dotpose/export.hpp"
#include "dotpose/tools/grey_image.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Flips an image left to right. Use this function for cameras or drivers that deliver mirrored
/// images.
inline void flip(GreyImage& image) {
    const auto width = static_cast<std::ptrdiff_t>(image.width_px);
    for (auto row = image.pixels.begin(); row != image.pixels.end(); row += width)
        std::reverse(row, row + width);
}

/// Returns a flipped copy of an image.
inline GreyImage flipped(ImageView image) {
    GreyImage result{{}, image.width_px, image.height_px};
    for (int v = 0; v < image.height_px; ++v)
        result.pixels.insert(result.pixels.end(), image.row(v), image.row(v) + image.width_px);
    flip(result);
    return result;
}

}  // namespace dotpose

DOTPOSE_END_EXPORT
