/// `dotpose calibrate --live`, which runs in dotpose-live because it opens a window. Each of the
/// two programs has its own definition of this function.
#pragma once

#include <string>

#include "dotpose/tools/calibrate.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

struct LiveCalibrationOptions {
    bool has_no_window = false;  ///< true to use the terminal even if there is a display
    /// Folder for the frames that are taken. Empty: the frames are not saved.
    std::string save;
};

/// Takes frames while the user moves the camera, shows the missing requirements, and calibrates the
/// lens. Ends when the frames suffice, the source ends or the user stops it. In `dotpose`, replaces
/// this process with dotpose-live. Throws Error if the source fails, or if the frames are too few
/// for the verdict `good`. The message then names the missing requirements.
LensCalibration calibrate_live(const SourceArguments& arguments, Sources& sources,
                               const CalibrateOptions& calibration,
                               const LiveCalibrationOptions& options);

}  // namespace dotpose::cli
