// What no calibration can do better than: the residual of perfect knowledge, and the Cramer-Rao
// bounds that the printer's jitter sets.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose {

/// A dot that a calibration used, and what is true of it.
struct TrueDot {
    int frame = 0;
    PixelPoint pixel;
    Vec2 off_mm;        ///< where it was seen on the paper, less where it was meant to be printed
    Vec2 displaced_mm;  ///< from its intersection, along the image axes
};
std::vector<TrueDot> true_dots(const LensCalibration& found, const std::vector<Shot>& shots);

/// What is not known beforehand of a mounted camera; the pose of each frame never is.
enum class Unknown {
    view,      ///< lens, scale along both axes, skew, perspective: as `calibrate_lens` has it
    square,    ///< lens, one scale, perspective
    straight,  ///< lens, one scale
};

/// The least standard deviations that these dots allow, by the names of `Camera::sigma`, if their
/// places err by `jitter_mm` along each axis.
std::map<std::string, double> least_sigmas(const Camera& camera, const std::vector<TrueDot>& dots,
                                           double jitter_mm, Unknown unknown);

}  // namespace dotpose
