// All dots: finds the dots of frames whose camera is known from a first fit.
#pragma once

#include <vector>

#include "calibrate/lens_fit.hpp"

namespace dotpose::calibrate {

/// Replaces the dots that `locate` read by all blobs that lie where `fit` expects the code's dots.
///
/// `locate` reads the dots that a pose needs. Where its plane fits badly, in the corners of a
/// slightly tilted camera, it leaves dots out, and mostly those whose errors add to the error of
/// the plane. The remaining dots show too little perspective: by three standard deviations at 8
/// degrees, as the unit test ASlightTiltTellsAnUnbiasedFocalLength measured without this function.
void take_all_dots(const LensFit& fit, const FitSetting& setting, CodeVariant code,
                   std::vector<LocatedFrame>& frames);

}  // namespace dotpose::calibrate
