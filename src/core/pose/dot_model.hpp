// Dot model: the image of a dot, and its derivatives with respect to the model parameters. The dot
// is an ellipse, blurred by a Gaussian and averaged over square pixels. The Gaussian also
// represents motion blur, so it may be oblique.
#pragma once

#include <array>
#include <cstddef>

#include "core/math/float_plane.hpp"

namespace dotpose::core {

/// A blurred ellipse in the image. Lengths are in px, and squared lengths in px^2.
struct ModelDot {
    FloatVec centre;    ///< relative to the middle of the central pixel
    FloatVec radius_2;  ///< squared semi-axes along u and v
    FloatVec blur_2;    ///< blur variance along u and v
    /// Covariance of the blur between u and v. Only its first-order effect is modelled.
    float blur_uv = 0;
};

/// Darkness of a square block of pixels, by row and column.
struct DotPixels {
    /// Distance from the central pixel to the outermost pixels along each axis.
    static constexpr int kHalf_px = 6;
    static constexpr std::size_t kSide = 2 * kHalf_px + 1;

    float& at(int u, int v) {
        return all[static_cast<std::size_t>(v + kHalf_px)][static_cast<std::size_t>(u + kHalf_px)];
    }
    float at(int u, int v) const {
        return all[static_cast<std::size_t>(v + kHalf_px)][static_cast<std::size_t>(u + kHalf_px)];
    }

    std::array<std::array<float, kSide>, kSide> all{};
};

/// Image of a model dot, and the derivatives of this image. The pixels of a dot sum to 1 if the dot
/// is completely within the drawn pixels.
struct DotImages {
    DotPixels dot;
    /// Derivatives with respect to the centre, the squared semi-axes and the blur variance, each
    /// along u and then along v, and with respect to the covariance of the blur. The effect of this
    /// covariance on the other derivatives is neglected.
    std::array<DotPixels, 7> derivatives;
};

/// Draws a dot. Computes only the pixels within `half_px` of the central pixel along each axis, and
/// sets all other pixels to 0.
DotImages draw(const ModelDot& dot, int half_px);

}  // namespace dotpose::core
