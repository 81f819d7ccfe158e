/// What lens, motion and pixel area make of a point: weights over sub-pixels.
#pragma once

#include <vector>

#include "dotpose/tools/simulate.hpp"

namespace dotpose::simulate {

struct Kernel {
    static constexpr int kMaxPerPixel = 8;
    int per_pixel = 2;     ///< sub-pixels per pixel and axis: 2, 4 or 8
    int border_px = 0;     ///< the kernel reaches this many pixels beyond its own
    std::size_t taps = 1;  ///< 2 * border_px + 1, and up to the next multiple of 4

    /// weights[phase][j]: share of the light on sub-pixel `phase` of pixel u that pixel
    /// u + j - border_px collects; j runs from 0 to 2 * border_px, and up to `taps` with weight 0.
    using Weights = std::vector<std::vector<float>>;

    /// The scene as it stands at one moment of the exposure.
    struct Moment {
        Weights x;
        Weights y;  ///< includes the share of this moment in the exposure
    };
    std::vector<Moment> moments;
};

/// dot_px: diameter of a dot in the image; decides how fine sub-pixels must be.
Kernel make_kernel(const Imperfections& imperfections, double dot_px);

}  // namespace dotpose::simulate
