// Encodes a grey image as a data URI, so that a drawing with an image is a single file.
#pragma once

#include <string>

#include "dotpose/image.hpp"

namespace dotpose::draw {

/// Returns "data:image/png;base64,...", or an empty string for an image without pixels. If the
/// longer side of the image exceeds `max_side_px`, the image is reduced by the smallest integer
/// factor that suffices, and the number of grey levels is reduced to 64. Throws Error if the image
/// cannot be encoded.
std::string data_uri(ImageView image, int max_side_px);

}  // namespace dotpose::draw
