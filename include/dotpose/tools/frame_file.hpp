/// Reads images that are to be located.
#pragma once

#include <filesystem>

#include "dotpose/locate.hpp"
#include "dotpose/tools/image_file.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Reads an image as `read_image` does. One that is larger than `locate` takes is not decoded:
/// throws ImageTooLarge.
inline GreyImage read_frame(const std::filesystem::path& path) {
    return read_image(path, kMaxFrameSide_px * kMaxFrameSide_px);
}

}  // namespace dotpose

#pragma GCC visibility pop
