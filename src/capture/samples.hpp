/// The samples of an image file, and the grey levels that they become.
#pragma once

#include <cstdint>
#include <vector>

#include "dotpose/tools/grey_image.hpp"

namespace dotpose::capture {

/// The samples of an image as its file has them, row by row; of 8 or 16 bits.
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

/// Returns the level of white in an image of 16 bits whose largest level is `largest`: of 8 to 12
/// bits, as sensors deliver them in the lower bits of 16, the largest of these bits.
std::uint32_t white_level(std::uint32_t largest);

}  // namespace dotpose::capture
