// Reads images with notes about their files.
#pragma once

#include <filesystem>
#include <string>

#include "dotpose/tools/grey_image.hpp"

namespace dotpose::capture {

/// Reads an image as `dotpose::read_image` does. Sets `note` to a sentence about a defect of the
/// file, such as a missing end marker, or to an empty text.
GreyImage read_image(const std::filesystem::path& path, int max_pixels, std::string& note,
                     int page = 1);

}  // namespace dotpose::capture
