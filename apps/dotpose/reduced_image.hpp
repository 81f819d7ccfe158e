/// Images larger than `locate` takes, such as scans of large pages: reduced by a whole number.
#pragma once

#include "dotpose/fix.hpp"
#include "dotpose/options.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::cli {

/// The least number by which an image of this size has to be reduced; 1: it can be located as it
/// is, or hardly anything would be left of it.
int reduction_of(int width_px, int height_px);

/// Every pixel is the mean of `by` x `by`; what is left over at the right and at the bottom is cut
/// off.
GreyImage reduced(const GreyImage& image, int by);

/// Options for an image reduced by `by` that mean what `options` mean for `image`: lens and
/// reference point stay on the same spots of the scene.
Options reduced(const Options& options, const GreyImage& image, int by);

/// The fix of a reduced image, with its pixels counted in those of the whole one.
Fix in_whole_pixels(const Fix& fix, int by);

}  // namespace dotpose::cli
