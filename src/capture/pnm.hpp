/// Reads PBM, PGM and PPM, text and binary (P1 to P6), as netpbm specifies them.
///
/// Not left to the decoding library, because it reads damaged headers (a negative width, for one)
/// as good ones and writes to standard error when a header has two comments.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/tools/grey_image.hpp"

namespace dotpose::capture {

/// `bytes` start with a magic that `sniff` knows. Throws Error with the reason only.
GreyImage decode_pnm(std::span<const std::uint8_t> bytes, int max_pixels);

}  // namespace dotpose::capture
