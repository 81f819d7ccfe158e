/// Selects the calibration frames for `dotpose calibrate`.
#pragma once

#include <string>
#include <vector>

#include "dotpose/tools/calibrate.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

/// Error message for mirrored frames.
inline constexpr const char* kMirrored =
    "the frames show the pattern mirrored: use --flip, which is then written into the camera file";

/// The frames for a calibration: all given images and, from each video, camera or raw stream, up to
/// 50 frames that show different places. Images are read on demand. The other frames are kept in
/// memory.
class CalibrationFrames {
  public:
    /// Reads videos and raw streams to the end, and reads cameras until 50 different places have
    /// been captured. Ctrl-C ends the current source early. Throws Error if a source fails, if no
    /// frame of a source can be located, or after a signal other than Ctrl-C.
    CalibrationFrames(const SourceArguments& arguments, Sources& sources,
                      const CalibrateOptions& options);

    int count() const { return static_cast<int>(frames_.size()); }

    /// Returns frame `index`. Throws Error if the image cannot be read.
    GreyImage at(int index) const;

    /// Returns true if at least one of the first three frames is mirrored. Throws Error if an image
    /// cannot be read.
    bool are_mirrored(const CalibrateOptions& options) const;

  private:
    struct Frame {
        std::string file;  ///< path of an image, or empty for a frame in memory
        GreyImage image;
    };

    void choose(const std::string& source, const capture::SourceOptions& options,
                const CalibrateOptions& calibration);

    std::vector<Frame> frames_;
    capture::SourceOptions options_;
};

}  // namespace dotpose::cli
