// Smooth: the filter of the second attempt. It normalises the light, filters pixel noise at the
// size of a blurred dot, and removes single defect pixels. differs: not in the paper;
// docs/differs-from-paper.md.
#pragma once

#include "core/stages.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Grey level to which the mean of the surroundings is scaled.
inline constexpr int kNormalLevel = 192;

/// Starts an image and discards the rows of the previous one.
void begin_smoothing(const ImageView& image, Smoothing& smoothing);

/// Returns the next row, from the top, of the filtered image. Each pixel is clamped to the range of
/// its eight neighbours, weighted with the 5 x 5 binomial (sigma 1 px), and divided by the mean of
/// a rectangle around it. The row is valid until the next call.
const std::uint8_t* next_smooth_row(const ImageView& image, Smoothing& smoothing);

}  // namespace dotpose::core
