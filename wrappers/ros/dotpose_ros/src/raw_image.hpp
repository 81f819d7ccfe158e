/// Converts raw images in the encodings of sensor_msgs/Image to grey images.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <dotpose/image.hpp>
#include <dotpose/tools/grey_image.hpp>

namespace dotpose_ros {

/// Members of a sensor_msgs/Image that describe its pixels.
struct RawImage {
    std::string encoding;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t step = 0;  ///< distance between the starts of consecutive rows, in bytes
    bool is_bigendian = false;
    std::span<const std::uint8_t> data;
};

/// Returns the grey levels of an image. If the encoding has 8-bit grey levels, the result is a view
/// of the data, otherwise a view of `buffer`.
/// - Colours are converted to luma (Rec. 601).
/// - Levels of more than 8 bits are divided by the smallest power of two that reduces the brightest
///   pixel to 8 bits, because cameras with 10 or 12 bits use 16-bit encodings.
/// - Each pixel of a Bayer mosaic is replaced with a weighted mean of 3 x 3 pixels, in which each
///   colour has the same total weight at every pixel.
///
/// Throws dotpose::Error if the encoding is not supported, or if the image has less data than its
/// size requires. The error message suggests a remedy.
dotpose::ImageView grey_view(const RawImage& image, dotpose::GreyImage& buffer);

}  // namespace dotpose_ros
