/// Reads images for locating.
#pragma once

#include <filesystem>

#include "dotpose/export.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/image_file.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Reads an image as `read_image` does. Throws ImageTooLarge, without decoding, for an image larger
/// than `locate` accepts.
inline GreyImage read_frame(const std::filesystem::path& path) {
    return read_image(path, kMaxFrameSide_px * kMaxFrameSide_px);
}

}  // namespace dotpose

DOTPOSE_END_EXPORT
