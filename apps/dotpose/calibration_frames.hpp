/// The frames that `calibrate` works with.
#pragma once

#include <string>
#include <vector>

#include "dotpose/tools/calibrate.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

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

  private:
    struct Frame {
        std::string file;  ///< of an image; empty for a frame that is kept
        GreyImage image;
    };

    void choose(const std::string& source, const capture::SourceOptions& options,
                const CalibrateOptions& calibration);

    std::vector<Frame> frames_;
    std::optional<capture::Region> region_;
};

}  // namespace dotpose::cli
