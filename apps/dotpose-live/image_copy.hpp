/// Copies the image of a frame. The original is valid only until the next frame is read.
#pragma once

#include <cstddef>

#include "dotpose/image.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::cli {

inline GreyImage copy_of(ImageView image) {
    GreyImage copy{{}, image.width_px, image.height_px};
    copy.pixels.reserve(static_cast<std::size_t>(image.width_px) *
                        static_cast<std::size_t>(image.height_px));
    for (int v = 0; v < image.height_px; ++v)
        copy.pixels.insert(copy.pixels.end(), image.row(v), image.row(v) + image.width_px);
    return copy;
}

}  // namespace dotpose::cli
