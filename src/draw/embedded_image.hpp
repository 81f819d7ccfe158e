// Encodes a grey image as a data URI, so that a drawing with an image is a single file.
#pragma once

#include <string>

#include "dotpose/image.hpp"

namespace dotpose::draw {

/// Returns "data:image/png;base64,...", or an empty string for an image without pixels. If the
/// image is larger than `max_side_px`, it is reduced by an integer factor and to 64 grey levels.
/// Throws Error if it cannot be encoded.
std::string data_uri(ImageView image, int max_side_px);

}  // namespace dotpose::draw
