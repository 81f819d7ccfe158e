// Determines the printed spacing of the sheet in calibration frames.
#pragma once

#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/tools/calibrate.hpp"

namespace dotpose::calibrate {

/// Returns the printed spacing, in mm, of the sheet in `options` that contains the most elements of
/// `places`. If `options` has no sheets, returns the spacing of `options.pattern`. Throws Error if
/// no sheet contains any of the places.
double printed_spacing_mm(const CalibrateOptions& options, CodeVariant code,
                          const std::vector<Place>& places);

}  // namespace dotpose::calibrate
