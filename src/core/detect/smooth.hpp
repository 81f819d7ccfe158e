// Smooth: a second look at a frame that a first attempt could not read, with uneven light evened
// out, pixel noise filtered at the size of a blurred dot, and single defect pixels removed.
// differs: not in the paper; docs/differs-from-paper.md.
#pragma once

#include "core/stages.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Grey level that the mean of the surroundings becomes.
inline constexpr int kEvenLevel = 192;

/// Forgets the rows of the last image.
void begin_smoothing(const ImageView& image, Smoothing& smoothing);

/// The next row, from the top, of the image filtered: each pixel limited to the range of its eight
/// neighbours, weighted with the 5 x 5 binomial (sigma 1 px), and divided by the mean of a
/// rectangle around it. Valid until the next call.
const std::uint8_t* next_smooth_row(const ImageView& image, Smoothing& smoothing);

}  // namespace dotpose::core
