/// Point spread function due to lens, motion and pixel area, as sub-pixel weights.
#pragma once

#include <vector>

#include "dotpose/tools/simulate.hpp"

namespace dotpose::simulate {

struct Kernel {
    static constexpr int kMaxPerPixel = 8;
    int per_pixel = 2;     ///< sub-pixels per pixel along each axis: 2, 4 or 8
    int border_px = 0;     ///< number of pixels by which the kernel extends beyond its centre pixel
    std::size_t taps = 1;  ///< 2 * border_px + 1, rounded up to a multiple of 4

    /// weights[phase][j] is the fraction of the light on sub-pixel `phase` of pixel u that
    /// contributes to pixel u + j - border_px, for j from 0 to 2 * border_px. Weights with a larger
    /// j, up to `taps`, are zero.
    using Weights = std::vector<std::vector<float>>;

    /// Weights for the scene at one moment of the exposure.
    struct Moment {
        Weights x;
        Weights y;  ///< scaled by the fraction of the exposure that this moment represents
    };
    std::vector<Moment> moments;
};

/// Computes the kernel. If `Imperfections::sub_pixels` is 0, the number of sub-pixels is chosen
/// according to `dot_px`, the diameter of a dot in the image, in px.
Kernel make_kernel(const Imperfections& imperfections, double dot_px);

}  // namespace dotpose::simulate
