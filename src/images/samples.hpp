/// Converts the samples of an image file to grey levels.
#pragma once

#include <cstdint>
#include <vector>

#include "dotpose/tools/grey_image.hpp"

namespace dotpose::images {

/// Samples of an image as stored in its file, row by row, with 8 or 16 bits.
template <typename Sample>
struct Samples {
    int width_px = 0;
    int height_px = 0;
    int channels = 1;  ///< 1 (grey), 2 (grey, opacity), 3 (RGB) or 4 (RGB, opacity)
    std::vector<Sample> values;
};

/// Converts samples to grey as described in image_file.hpp. Rounds only the final level.
GreyImage to_grey(Samples<std::uint8_t> samples);
GreyImage to_grey(Samples<std::uint16_t> samples);

/// Returns the white level of a 16-bit image whose maximum level is `max_level`. Many sensors store
/// values of 8 to 12 bits in 16-bit samples. White is then the largest value that fits in these
/// bits.
std::uint32_t white_level(std::uint32_t max_level);

}  // namespace dotpose::images
