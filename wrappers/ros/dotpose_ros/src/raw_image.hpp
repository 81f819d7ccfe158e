/// Raw images: the encodings of sensor_msgs/Image, as grey images.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <dotpose/image.hpp>
#include <dotpose/tools/grey_image.hpp>

namespace dotpose_ros {

/// The members of a sensor_msgs/Image that describe its pixels.
struct RawImage {
    std::string encoding;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t step = 0;  ///< bytes from one row to the next
    bool is_bigendian = false;
    std::span<const std::uint8_t> data;
};

/// Returns the grey levels of an image: a view of its data where these are grey levels of 8 bits,
/// otherwise of `buffer`. Colours become their luma (Rec. 601). Levels of more than 8 bits are
/// reduced by the power of two that the brightest pixel needs, because cameras of 10 and 12 bits
/// send theirs in 16. In a Bayer mosaic each pixel becomes the weighted mean of 3 x 3, to which
/// every colour contributes the same share everywhere.
/// Throws dotpose::Error with the remedy if the encoding is not known, or if the data are fewer
/// than the size requires.
dotpose::ImageView grey_view(const RawImage& image, dotpose::GreyImage& buffer);

}  // namespace dotpose_ros
