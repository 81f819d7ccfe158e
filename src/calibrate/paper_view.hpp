// Computes scale, tilt and focal length of a camera from its lens fit.
#pragma once

#include "calibrate/lens_fit.hpp"

namespace dotpose::calibrate {

/// Sets `camera.paper`. If the tilt of the camera is significant, also sets the tilt and the focal
/// length, assuming square pixels.
void describe_mounted(const LensFit& fit, double reach_px, Camera& camera);

/// Sets the standard deviations of the position of the image centre and of the direction of the
/// image x axis, relative to the dots in view. The results are much smaller than the standard
/// deviations of the parameters suggest, because the errors of the parameters largely cancel at the
/// image centre. Requires `camera.paper`.
void describe_centre(const LensFit& fit, double reach_px, Camera& camera);

/// Sets the focal length if the tilts of the frames determine it.
void describe_handheld(const LensFit& fit, double reach_px, Camera& camera);

}  // namespace dotpose::calibrate
