// All dots: finds all dots of the frames, given a first fit of the camera.
#pragma once

#include <vector>

#include "calibrate/lens_fit.hpp"

namespace dotpose::calibrate {

/// Replaces the dots that `locate` read with all blobs at places where `fit` expects a dot of the
/// code. If there are fewer than half as many such blobs as dots, the frame keeps its dots.
///
/// `locate` reads only the dots that a pose needs. In the corners of the image of a slightly tilted
/// camera, the plane of `locate` fits badly, and `locate` omits the dots with large residuals. The
/// perspective fitted to the remaining dots is too small: by three standard deviations at a tilt of
/// 8 degrees, measured without this function by the unit test
/// ASlightTiltTellsAnUnbiasedFocalLength.
void take_all_dots(const LensFit& fit, const FitSetting& setting, CodeVariant code,
                   std::vector<LocatedFrame>& frames);

}  // namespace dotpose::calibrate
