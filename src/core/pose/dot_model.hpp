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
    /// Row and column of the central pixel. The lines are longer than the block, so that the pixels
    /// within 3 px of the central pixel, and one more, are in two vectors of four.
    static constexpr int kMiddle = kHalf_px + 1;
    static constexpr std::size_t kLine = 16;
    using Line = std::array<float, kLine>;

    float& at(int u, int v) { return all[index(v)][index(u)]; }
    float at(int u, int v) const { return all[index(v)][index(u)]; }

    /// Returns the row or column of a pixel. `from_middle` is in the range [-kMiddle, kMiddle].
    static constexpr std::size_t index(int from_middle) {
        return static_cast<std::size_t>(from_middle + kMiddle);
    }

    alignas(16) std::array<Line, kLine - 2> all{};
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

/// Draws a dot. Computes the pixels within `half_px` of the central pixel along each axis. The
/// other pixels are unspecified, but finite.
DotImages draw(const ModelDot& dot, int half_px);

}  // namespace dotpose::core
