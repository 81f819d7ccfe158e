/// What `calibrate` says.
#pragma once

#include <string>

#include "dotpose/calibrate.hpp"

namespace dotpose::cli {

std::string lens_report(const LensCalibration& calibration);

}  // namespace dotpose::cli
