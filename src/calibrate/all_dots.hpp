// Finds all dots in the frames, given a first fit of the camera.
#pragma once

#include <vector>

#include "calibrate/lens_fit.hpp"

namespace dotpose::calibrate {

/// Replaces the dots that `locate` read in each frame with all blobs close to a dot position
/// predicted by `fit`. A frame keeps its dots if it has fewer than half as many such blobs as dots.
///
/// `locate` reads only the dots that it needs for a pose. If the camera is slightly tilted, the
/// plane that `locate` fits is inaccurate in the corners of the image, so `locate` omits dots with
/// large residuals there. The perspective fitted to the remaining dots is therefore too small: at a
/// tilt of 8 degrees, the focal length would be wrong by three standard deviations (unit test
/// ASlightTiltTellsAnUnbiasedFocalLength).
void take_all_dots(const LensFit& fit, const FitSetting& setting, CodeVariant code,
                   std::vector<LocatedFrame>& frames);

}  // namespace dotpose::calibrate
