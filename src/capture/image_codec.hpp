/// Converts between file contents and grey images. Only this file uses the decoding library.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "capture/image_format.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::capture {

/// Decodes an image of any format but PNM, with the conversions and limits that image_file.hpp
/// describes. `note` is set like that of `read_image`, without the name of the file. Throws Error
/// that has only the reason; the caller adds the name of the file.
GreyImage decode_image(ImageFormat format, std::span<const std::uint8_t> bytes, int max_pixels,
                       std::string& note, int page = 1);

/// Returns the resolution that the file states, without decoding the pixels. Throws Error that has
/// only the reason.
std::optional<Resolution> decode_resolution(ImageFormat format, std::span<const std::uint8_t> bytes,
                                            int page = 1);

/// Formats in which frames are saved.
enum class FrameFormat : std::uint8_t {
    png,   ///< without loss
    jpeg,  ///< with a quality of 95
    pgm,   ///< without loss and compression
};

/// Encode an image, which must not be empty. Throw Error if the encoder fails.
std::vector<std::uint8_t> encode_png(const GreyImage& image);
std::vector<std::uint8_t> encode(FrameFormat format, const GreyImage& image);

}  // namespace dotpose::capture
