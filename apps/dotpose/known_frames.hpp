/// Frames with true poses, for `dotpose evaluate`.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/tools/evaluate.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

struct KnownFrames {
    std::vector<TruthRow> rows;  ///< true pose of each frame; `file` is its path or name
    /// Returns a frame. If the frame cannot be read, its `problem` contains the reason.
    dotpose::FrameSource frame_at;
    /// Must be called after the last frame. Warns on standard error if there are more frames than
    /// poses.
    std::function<void()> finish = [] {};
};

/// Returns the frames of the sources with their poses. The poses are read from `poses` or, without
/// it, from truth.csv beside the images or the video. A folder has the frames of all rows of its
/// file; another image has the row whose `file` names it. If a video, a camera or raw frames are
/// among the sources, row N belongs to frame N, counted over all sources. Throws Error if there are
/// no poses, or no pose of an image.
KnownFrames known_frames(const SourceArguments& arguments, const std::string& poses,
                         std::optional<double> spacing_mm);

}  // namespace dotpose::cli
