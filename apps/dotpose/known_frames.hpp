/// The frames of `evaluate`, each with its true pose.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/tools/evaluate.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

struct KnownFrames {
    std::vector<TruthRow> rows;     ///< of each frame; `file` is its path or name
    dotpose::FrameSource frame_at;  ///< one that cannot be read has a `problem`
    /// Writes to standard error if there are more frames than poses. Called at the end.
    std::function<void()> finish = [] {};
};

/// Poses are read from `poses`, or without it from truth.csv beside the images or the video: of a
/// folder, all of that file; of other images, the rows whose `file` is theirs. If a video, a camera
/// or raw frames are among the sources, row N is that of frame N over all sources. Throws Error if
/// no poses are found, or an image is not among them.
KnownFrames known_frames(const SourceArguments& arguments, const std::string& poses,
                         std::optional<double> spacing_mm);

}  // namespace dotpose::cli
