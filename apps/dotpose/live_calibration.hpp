/// `dotpose calibrate --live`, which is in the program that has windows. Each of the two programs
/// defines this function.
#pragma once

#include <string>

#include "dotpose/tools/calibrate.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

struct LiveCalibrationOptions {
    bool has_no_window = false;  ///< whether to use the terminal even where there is a display
    std::string save;            ///< folder for the frames that are taken; empty: they are not kept
};

/// Takes frames while the user moves the camera, shows what is still missing, and calibrates the
/// lens, until the frames are enough, the source ends or the user ends it. In `dotpose`, replaces
/// this process by dotpose-live. Throws Error if the source fails or the frames are too few for a
/// calibration of verdict `good`; its message then says what was missing.
LensCalibration calibrate_live(const SourceArguments& arguments, Sources& sources,
                               const CalibrateOptions& calibration,
                               const LiveCalibrationOptions& options);

}  // namespace dotpose::cli
