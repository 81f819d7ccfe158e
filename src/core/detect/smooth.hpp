// Smooth: filters a frame that the first attempt could not read. Uneven light is evened out, pixel
// noise filtered at the size of a blurred dot, and single defect pixels are removed. differs: not
// in the paper; docs/differs-from-paper.md.
#pragma once

#include "core/stages.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Grey level that the mean of the surroundings is scaled to.
inline constexpr int kEvenLevel = 192;

/// Starts an image; the rows of the last one are dropped.
void begin_smoothing(const ImageView& image, Smoothing& smoothing);

/// Returns the next row, from the top, of the filtered image: each pixel is limited to the range of
/// its eight neighbours, weighted with the 5 x 5 binomial (sigma 1 px), and divided by the mean of
/// a rectangle around it. The row is valid until the next call.
const std::uint8_t* next_smooth_row(const ImageView& image, Smoothing& smoothing);

}  // namespace dotpose::core
