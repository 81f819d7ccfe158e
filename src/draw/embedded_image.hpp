// Encodes a grey image as a data URI, so that a drawing and its image are one file.
#pragma once

#include <string>

#include "dotpose/image.hpp"

namespace dotpose::draw {

/// Returns "data:image/png;base64,...", or an empty string for an image without pixels. An image
/// whose sides are longer than `max_side_px` is reduced by a whole factor, and to 64 grey levels.
/// Throws Error if the image cannot be encoded.
std::string data_uri(ImageView image, int max_side_px);

}  // namespace dotpose::draw
