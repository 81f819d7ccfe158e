// Embedded image: a grey image as a data URI, so that a picture is one file.
#pragma once

#include <string>

#include "dotpose/image.hpp"

namespace dotpose::draw {

/// "data:image/png;base64,..."; empty for an image without pixels. Throws Error.
std::string data_uri(ImageView image);

}  // namespace dotpose::draw
