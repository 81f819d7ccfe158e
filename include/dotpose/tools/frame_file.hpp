/// Reads images for `locate`.
#pragma once

#include <filesystem>

#include "dotpose/export.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/image_file.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Variant of `read_image` that throws ImageTooLarge if the image is larger than `locate` accepts.
/// The pixels of such an image are not decoded.
inline GreyImage read_frame(const std::filesystem::path& path) {
    return read_image(path, kMaxFrameSide_px * kMaxFrameSide_px);
}

}  // namespace dotpose

DOTPOSE_END_EXPORT
