/// `dotpose calibrate --live`. This part of the command runs in dotpose-live, because it opens a
/// window. Therefore `dotpose` and dotpose-live define this function differently.
#pragma once

#include <string>

#include "dotpose/tools/calibrate.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

struct LiveCalibrationOptions {
    bool has_no_window = false;  ///< true to use the terminal even if there is a display
    /// Folder for the frames that are taken. If empty, the frames are not saved.
    std::string save;
};

/// Takes frames while the user moves the camera, shows the requirements that are not yet met, and
/// calibrates the lens. Ends when there are enough frames, when the source ends, or when the user
/// ends it. In `dotpose`, replaces this process with dotpose-live. Throws Error if the source
/// fails, or if there are too few frames for the verdict `good`. The message then names the unmet
/// requirements.
LensCalibration calibrate_live(const SourceArguments& arguments, Sources& sources,
                               const CalibrateOptions& calibration,
                               const LiveCalibrationOptions& options);

}  // namespace dotpose::cli
