// Reference values for the errors of a calibration: the residuals of the dots given the true
// parameters, and the Cramer-Rao bounds on the parameter errors given the jitter of the printed
// dots.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::tables {

/// A dot used by a calibration, with its residual given the true parameters.
struct TrueDot {
    int frame = 0;
    PixelPoint pixel;
    Vec2 off_mm;        ///< measured position on the paper minus nominal position
    Vec2 displaced_mm;  ///< displacement of the dot from its intersection, along the image axes
};
std::vector<TrueDot> true_dots(const LensCalibration& found, const std::vector<Shot>& shots);

/// Parameters of a mounted camera that are estimated in addition to the pose of each frame.
enum class Unknown {
    view,      ///< lens, scale along both axes, skew and perspective, as in `calibrate_lens`
    square,    ///< lens, one scale, perspective
    straight,  ///< lens, one scale
};

/// Returns the Cramer-Rao bounds: the minimum standard deviation that an unbiased estimate of each
/// parameter from `dots` can have. The keys are the names in `Camera::sigma`. `jitter_mm` is the
/// standard deviation of a printed dot's position along each axis.
std::map<std::string, double> min_sigmas(const Camera& camera, const std::vector<TrueDot>& dots,
                                         double jitter_mm, Unknown unknown);

}  // namespace dotpose::tables
