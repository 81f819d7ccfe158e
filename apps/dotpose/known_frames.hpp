/// Frames with true poses, for `dotpose evaluate`.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/tools/evaluate.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

struct KnownFrames {
    std::vector<TruthRow> rows;  ///< true pose of each frame; `file` is the frame's path or name
    /// Returns a frame. If the frame cannot be read, its `problem` contains the reason.
    dotpose::FrameSource frame_at;
    /// Returns the number of frames, or the index of the first frame that was not read because the
    /// run was interrupted.
    std::function<std::size_t()> readable_frames;
    /// Must be called after the last frame. Warns on standard error if there are more frames than
    /// poses.
    std::function<void()> finish = [] {};
};

/// Returns the frames of the sources with their poses. The poses are read from `poses` or, if
/// `poses` is empty, from truth.csv beside the images or the video. For a folder, returns the
/// frames of all rows of its truth.csv. Any other image has the pose of the row whose `file` is the
/// name of the image. If the sources include a video, a camera or raw frames, row N belongs to
/// frame N, counted over all sources. Throws Error if there are no poses, or if an image has no
/// pose.
KnownFrames known_frames(const SourceArguments& arguments, const std::string& poses,
                         std::optional<double> spacing_mm);

}  // namespace dotpose::cli
