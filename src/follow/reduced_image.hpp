/// Reduces images that are too large for `locate`, such as scans of large pages.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::follow_detail {

/// Returns the smallest integer factor by which an image of this size must be reduced for `locate`.
/// Returns 1 if the image is small enough or would become too small.
int reduction_of(int width_px, int height_px);

/// Returns a reduced image in which each pixel is the mean of `by` x `by` pixels. Incomplete blocks
/// at the right and bottom edges are dropped.
GreyImage reduced(ImageView image, int by);

/// Converts options for `image` to options for the image reduced by `by`. The distortion centre and
/// the reference point stay at the same points of the scene.
DeviceOptions reduced(const DeviceOptions& options, ImageView image, int by);

/// Converts a fix from the pixel coordinates of an image reduced by `by` to those of the original
/// image.
Fix in_whole_pixels(const Fix& fix, int by);

}  // namespace dotpose::follow_detail
