// Finds all dots of the frames, given a first fit of the camera.
#pragma once

#include <vector>

#include "calibrate/lens_fit.hpp"

namespace dotpose::calibrate {

/// Replaces the dots that `locate` read with all blobs at positions where `fit` predicts a dot.
/// Keeps the dots of a frame if fewer than half as many blobs are found.
///
/// `locate` reads only the dots that a pose needs. In the corners of the image of a slightly tilted
/// camera, the plane that `locate` fits is inaccurate, so `locate` omits the dots with large
/// residuals. The perspective fitted to the remaining dots is therefore too small: at a tilt of 8
/// degrees, the computed focal length would be wrong by three standard deviations (unit test
/// ASlightTiltTellsAnUnbiasedFocalLength).
void take_all_dots(const LensFit& fit, const FitSetting& setting, CodeVariant code,
                   std::vector<LocatedFrame>& frames);

}  // namespace dotpose::calibrate
