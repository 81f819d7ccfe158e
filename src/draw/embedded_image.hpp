// Encodes a grey image as a data URI. With the image embedded, the drawing is a single file.
#pragma once

#include <string>

#include "dotpose/image.hpp"

namespace dotpose::draw {

/// Returns "data:image/png;base64,...", or an empty string for an image without pixels. Images
/// larger than `max_side_px` are reduced by an integer factor and to 64 grey levels. Throws Error
/// if the image cannot be encoded.
std::string data_uri(ImageView image, int max_side_px);

}  // namespace dotpose::draw
