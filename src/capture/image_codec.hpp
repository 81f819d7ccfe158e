/// Between file contents and grey images; the only place that knows the decoding library.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "capture/image_format.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::capture {

/// All formats but PNM. Conversions and limits as in image_file.hpp. Throws Error with the reason
/// only; the caller knows the file's name.
GreyImage decode_image(ImageFormat format, std::span<const std::uint8_t> bytes, int max_pixels);

/// What the file states, without decoding the pixels. Throws Error with the reason only.
std::optional<Resolution> decode_resolution(ImageFormat format,
                                            std::span<const std::uint8_t> bytes);

/// `image` must not be empty. Throws Error if the encoder fails.
std::vector<std::uint8_t> encode_png(const GreyImage& image);

}  // namespace dotpose::capture
