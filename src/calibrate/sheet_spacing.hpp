// Sheet spacing: the spacing of the sheet that calibration frames show.
#pragma once

#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/tools/calibrate.hpp"

namespace dotpose::calibrate {

/// Returns the spacing, in mm, of the sheet of `options` that holds most of the places, as it was
/// printed; without sheets that of the pattern of `options`. Throws Error if no sheet holds one.
double printed_spacing_mm(const CalibrateOptions& options, CodeVariant code,
                          const std::vector<Place>& places);

}  // namespace dotpose::calibrate
