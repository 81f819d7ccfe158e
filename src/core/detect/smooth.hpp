// Smooth: the image filter for the second attempt. The filter normalises the illumination, averages
// out noise over an area about as large as a blurred dot, and removes isolated defective pixels.
// Unlike the paper, the second attempt filters the image before it detects dots. See
// docs/differs-from-paper.md.
#pragma once

#include <cstdint>
#include <span>

#include "core/detect/paper.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// State of the filter: the rows and sums from which the next filtered row is computed.
struct Smoothing {
    std::span<std::uint16_t> lines;  ///< the five newest rows, filtered horizontally
    std::span<std::uint8_t> row;
    int lines_ready = 0;
    int rows_given = 0;
    PaperMap paper;
    /// Sum of each column over the rows [sums_begin, sums_end).
    std::span<std::uint32_t> column_sums;
    int sums_begin = 0;
    int sums_end = 0;
};

/// Grey level to which the local mean is scaled.
inline constexpr int kNormalLevel = 192;

void begin_smoothing(const ImageView& image, Smoothing& smoothing);

/// Returns the next row of the filtered image. The first call returns the top row. The row is valid
/// until the next call.
///
/// The filter clamps each pixel to the range of its eight neighbours, except at the image border.
/// It then applies a 5 x 5 binomial filter (sigma 1 px), and scales the result so that the mean
/// level of a rectangle around the pixel becomes kNormalLevel. This mean is computed from the
/// unfiltered image, with dark graphics replaced by the paper level.
const std::uint8_t* next_smooth_row(const ImageView& image, Smoothing& smoothing);

}  // namespace dotpose::core
