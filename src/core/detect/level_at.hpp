// Level at: what an image shows at a point between its pixels, seen through a small window.
#pragma once

#include "core/stages.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Whether there is a pixel to either side of a point.
bool shows_level(const ImageView& image, Vec point_q8);

/// Grey level in 2^-8, the mean of 4 x 4 pixels without their defects, weighted with the binomial
/// (1 2 1) along both axes. Where the image shows one.
int level_at_q8(const ImageView& image, Vec point_q8);

}  // namespace dotpose::core
