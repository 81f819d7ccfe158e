/// Reads PBM, PGM and PPM, text and binary (P1 to P6), as specified by netpbm. Writes PGM.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dotpose/tools/grey_image.hpp"

namespace dotpose::capture {

/// Decodes an image. `bytes` must start with the magic number of a PNM format. Throws Error with
/// only the reason.
GreyImage decode_pnm(std::span<const std::uint8_t> bytes, int max_pixels);

/// Encodes an image as binary PGM (P5).
std::vector<std::uint8_t> encode_pgm(ImageView image);

}  // namespace dotpose::capture
