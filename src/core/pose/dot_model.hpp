// Dot model: what a camera makes of a dot. An ellipse, blurred by a Gaussian and averaged over
// square pixels, with the derivatives that are needed to fit it.
#pragma once

#include <array>
#include <cstddef>

#include "core/math/float_plane.hpp"

namespace dotpose::core {

/// An ellipse in the image, in px and px^2.
struct ModelDot {
    FloatVec centre;    ///< from the middle of the pixel in the middle
    FloatVec radius_2;  ///< squared half axes along u and v
    FloatVec blur_2;    ///< variance of the blur along each axis
};

/// A square of pixels: row, then column.
struct DotPixels {
    static constexpr int kHalf_px = 6;  ///< from the pixel in the middle to the last one
    static constexpr std::size_t kSide = 2 * kHalf_px + 1;

    float& at(int u, int v) {
        return all[static_cast<std::size_t>(v + kHalf_px)][static_cast<std::size_t>(u + kHalf_px)];
    }
    float at(int u, int v) const {
        return all[static_cast<std::size_t>(v + kHalf_px)][static_cast<std::size_t>(u + kHalf_px)];
    }

    std::array<std::array<float, kSide>, kSide> all{};
};

/// Images of a model dot whose darkness adds up to 1, and of its derivatives.
struct DotImages {
    DotPixels dot;
    /// By the centre, the squared half axis, and the blur, each along u and then along v.
    std::array<DotPixels, 6> derivatives;
};

/// Draws the pixels that are at most `half_px` from the one in the middle; others are 0.
DotImages draw(const ModelDot& dot, int half_px);

}  // namespace dotpose::core
