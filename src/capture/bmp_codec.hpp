/// Reads BMP: the headers of Windows 3 to 5 and of OS/2; palettes of 1, 4 and 8 bits; 16, 24 and 32
/// bits without compression. Microsoft documents the layout under BITMAPV5HEADER.
#pragma once

#include <optional>

#include "capture/bytes.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::capture {

/// These functions throw Error with only the reason; the caller adds the name of the file.
GreyImage decode_bmp(Bytes file, int max_pixels);
std::optional<Resolution> bmp_resolution(Bytes file);

}  // namespace dotpose::capture
