// Tells from its name what a source of frames is.
#pragma once

#include <string>
#include <vector>

namespace dotpose::capture {

enum class SourceKind {
    raw,     ///< "-": raw frames on standard input
    camera,  ///< a number, /dev/video..., or a URL
    image,   ///< one image file, or what is neither of the others
    images,  ///< a folder, or a glob that is no file itself
    video,   ///< a file whose name ends like a video's, or whose first bytes are those of one
};

SourceKind kind_of(const std::string& name);

/// Whether the name is a URL of a source in the network.
bool is_url(const std::string& name);

/// Whether the source is a camera or a video, which only the layer `video` can open.
bool needs_video_libraries(SourceKind kind);

/// Returns the images of a folder or glob, in the order of their names. Throws Error if the folder
/// cannot be read, or there are none.
std::vector<std::string> images_at(const std::string& name);

/// Returns the files that a source of this name reads: images, a video, or "-"; none for a camera.
/// Throws Error like `images_at`.
std::vector<std::string> files_of(const std::string& name);

}  // namespace dotpose::capture
