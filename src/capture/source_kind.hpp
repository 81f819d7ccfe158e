// Determines the kind of a frame source from its name.
#pragma once

#include <string>
#include <vector>

namespace dotpose::capture {

enum class SourceKind {
    raw,     ///< "-": raw frames on standard input
    camera,  ///< a number, /dev/video..., or a URL
    image,   ///< an image file, or a name that matches no other kind
    images,  ///< a folder, or a glob pattern that is not an existing path
    video,   ///< a file with the extension or the signature of a video
};

SourceKind kind_of(const std::string& name);

/// Returns true if the name is the URL of a network source.
bool is_url(const std::string& name);

/// Returns true for cameras and videos, which only the `video` layer can open.
bool needs_video_libraries(SourceKind kind);

/// Returns the images that are in a folder or match a glob, sorted by name. Throws Error if the
/// folder cannot be read or there are no images.
std::vector<std::string> images_at(const std::string& name);

/// Returns the files of a source: images, a video, or "-" for standard input. Returns an empty list
/// for a camera. Throws Error in the same cases as `images_at`.
std::vector<std::string> files_of(const std::string& name);

}  // namespace dotpose::capture
