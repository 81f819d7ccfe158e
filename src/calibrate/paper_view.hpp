// Paper view: scale, tilt and focal length of a camera, from the fit of its lens.
#pragma once

#include "calibrate/lens_fit.hpp"

namespace dotpose::calibrate {

/// Sets `paper`. If the camera is clearly tilted, also sets tilt and focal length: those of a
/// camera with square pixels that sees the paper in this way.
void describe_mounted(const LensFit& fit, double reach_px, Camera& camera);

/// Sets the standard deviations of the place and the direction of the image centre against the dots
/// in view; `paper` must be set. They are far smaller than those of the parameters, whose errors
/// cancel there.
void describe_centre(const LensFit& fit, double reach_px, Camera& camera);

/// Sets the focal length if the tilts of the frames determine it.
void describe_handheld(const LensFit& fit, double reach_px, Camera& camera);

}  // namespace dotpose::calibrate
