// Pale: whether the dots of a fix have less contrast than the options demand.
#pragma once

#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Whether the dots of a fix are less dark than the paper by `options.min_contrast` grey levels, on
/// the mean over the dots around the image centre.
bool is_pale(const ImageView& image, const Options& options, const Fix& fix);

}  // namespace dotpose::core
