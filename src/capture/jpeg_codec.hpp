/// Reads and writes JPEG with libjpeg.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "capture/bytes.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::capture {

/// These functions throw Error with only the reason. Decoding sets `note` if only the end marker is
/// missing.
GreyImage decode_jpeg(Bytes file, int max_pixels, std::string& note);
std::optional<Resolution> jpeg_resolution(Bytes file);

/// Encodes a non-empty image in grey with quality 95.
std::vector<std::uint8_t> encode_jpeg(ImageView image);

}  // namespace dotpose::capture
