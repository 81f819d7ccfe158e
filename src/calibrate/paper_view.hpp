// What a fit says of scale, tilt and focal length.
#pragma once

#include "calibrate/lens_fit.hpp"

namespace dotpose::calibrate {

/// Sets `paper`, and tilt and focal length if the camera is tilted so much that they show: those of
/// a camera with square pixels that sees the paper like this.
void describe_mounted(const LensFit& fit, double reach_px, Camera& camera);

/// Once `paper` is set: the standard deviations of where the image centre looks, and in which
/// direction, against the dots in view. They are far smaller than those of the parameters, whose
/// errors cancel out there.
void describe_centre(const LensFit& fit, double reach_px, Camera& camera);

/// Sets the focal length, if the tilts of the frames tell it.
void describe_handheld(const LensFit& fit, double reach_px, Camera& camera);

}  // namespace dotpose::calibrate
