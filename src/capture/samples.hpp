/// Converts the samples of an image file to grey levels.
#pragma once

#include <cstdint>
#include <vector>

#include "dotpose/tools/grey_image.hpp"

namespace dotpose::capture {

/// The samples of an image as stored in its file, row by row, with 8 or 16 bits.
template <typename Sample>
struct Samples {
    int width_px = 0;
    int height_px = 0;
    int channels = 1;  ///< 1 grey, 2 grey and opacity, 3 RGB, 4 RGB and opacity
    std::vector<Sample> values;
};

/// Converts samples to grey as image_file.hpp describes, with a single rounding.
GreyImage to_grey(Samples<std::uint8_t> samples);
GreyImage to_grey(Samples<std::uint16_t> samples);

/// Returns the level of white in an image of 16 bits with the maximum level `largest`. Sensors
/// deliver 8 to 12 bits in the lower bits of 16; white is then the maximum of these bits.
std::uint32_t white_level(std::uint32_t largest);

}  // namespace dotpose::capture
