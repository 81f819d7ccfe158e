/// The frames that `calibrate` works with.
#pragma once

#include <string>
#include <vector>

#include "dotpose/tools/calibrate.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

/// The error for frames in which the pattern is mirrored.
inline constexpr const char* kMirrored =
    "the frames show the pattern as in a mirror: use --flip, which is then written into the camera "
    "file";

/// All images that are named, and of videos, cameras and raw frames at most 50 that show new
/// places. Images stay on the disk; the chosen frames are kept in memory.
class CalibrationFrames {
  public:
    /// Reads videos and raw frames to their end, and a camera until it has shown enough or an
    /// interrupt ends it. Throws Error if a source fails, if none of its frames is located, or
    /// after an interrupt of another source.
    CalibrationFrames(const SourceArguments& arguments, Sources& sources,
                      const CalibrateOptions& options);

    int count() const { return static_cast<int>(frames_.size()); }

    /// Throws Error if the image cannot be read.
    GreyImage at(int index) const;

    /// Whether one of the first frames shows the pattern as in a mirror. Throws Error as `at`.
    bool are_mirrored(const CalibrateOptions& options) const;

  private:
    struct Frame {
        std::string file;  ///< of an image; empty for a frame that is kept
        GreyImage image;
    };

    void choose(const std::string& source, const capture::SourceOptions& options,
                const CalibrateOptions& calibration);

    std::vector<Frame> frames_;
    capture::SourceOptions options_;
};

}  // namespace dotpose::cli
