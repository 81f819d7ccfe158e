// Level at a point: interpolates the grey level of an image at sub-pixel positions.
#pragma once

#include "dotpose/geometry.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Returns true if the image has pixels on both sides of the point, along both axes.
bool shows_level(const ImageView& image, FixedVec point_q8);

/// Returns the grey level at a point, in units of 2^-8. Averages 4 x 4 pixels with the weights of a
/// 1-2-1 binomial filter centred on the point. Defective pixels are corrected. Requires
/// `shows_level(image, point_q8)`.
int level_at_q8(const ImageView& image, FixedVec point_q8);

}  // namespace dotpose::core
