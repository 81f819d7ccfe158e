// Encodes a grey image as a data URI, so that a drawing and its image are one file.
#pragma once

#include <string>

#include "dotpose/image.hpp"

namespace dotpose::draw {

/// Returns "data:image/png;base64,...", or an empty string for an image without pixels. Throws
/// Error if the image cannot be encoded.
std::string data_uri(ImageView image);

}  // namespace dotpose::draw
