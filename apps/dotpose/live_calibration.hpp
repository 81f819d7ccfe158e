/// Live calibration (`dotpose calibrate --live`). `calibrate_live` is implemented differently in
/// `dotpose` and dotpose-live, because only dotpose-live can open a window.
#pragma once

#include <string>

#include "dotpose/tools/calibrate.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

struct LiveCalibrationOptions {
    bool has_no_window = false;  ///< true to use the terminal even if a display is available
    /// Folder in which to save the captured frames, or empty to save none.
    std::string save;
};

/// Captures frames while the user moves the camera, displays the unmet requirements, and calibrates
/// the lens. Stops capturing when there are enough frames, when the source ends, or when the user
/// ends the capture. If called in `dotpose`, replaces the process with dotpose-live.
/// Throws Error in these cases:
/// - The source fails.
/// - There are too few frames for the `good` verdict. The error message lists the unmet
///   requirements.
LensCalibration calibrate_live(const SourceArguments& arguments, Sources& sources,
                               const CalibrateOptions& calibration,
                               const LiveCalibrationOptions& options);

}  // namespace dotpose::cli
