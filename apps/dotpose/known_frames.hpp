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
    std::vector<TruthRow> rows;  ///< true poses, with the path or name of each frame in `file`
    /// Returns a frame. If the frame cannot be read, `problem` in the result contains the reason.
    dotpose::FrameSource frame_at;
    /// Returns the number of frames. If the run was interrupted, returns the number of frames read
    /// before the interruption.
    std::function<std::size_t()> readable_frames;
    /// Warns on standard error if there are more frames than poses. Must be called after the last
    /// frame has been read.
    std::function<void()> finish = [] {};
};

/// Returns the frames from the sources, together with their true poses. The pose file is `poses`
/// or, if `poses` is empty, truth.csv next to the images or the video.
/// - For a folder, only the frames listed in the pose file are returned.
/// - For an image, the pose is in the row whose `file` is the name of the image.
/// - If the sources include a video, a camera or a raw stream, row N contains the pose of frame N.
///   The frames are numbered across all sources.
///
/// Throws Error if there are no poses, or if an image has no pose.
KnownFrames known_frames(const SourceArguments& arguments, const std::string& poses,
                         std::optional<double> spacing_mm);

}  // namespace dotpose::cli
