/// Reads and writes PNG with libpng.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "capture/bytes.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::capture {

/// These functions throw Error with only the reason.
GreyImage decode_png(Bytes file, int max_pixels);
std::optional<Resolution> png_resolution(Bytes file);

/// Encodes a non-empty image in 8-bit grey. Equal images yield equal bytes.
std::vector<std::uint8_t> encode_png(ImageView image);

}  // namespace dotpose::capture
