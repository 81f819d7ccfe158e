// The second attempt, for tilted cameras, lenses that bend, noise, uneven light and graphics.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Locates on the image filtered; bits are read from it rather than from blobs. The steps, one
/// after the other:
Fix make_second_attempt(const ImageView& image, const Options& options, Workspace& w);

/// Image, filtered -> dots -> grid -> bits, which have nothing to do with the profile.
/// `not_certain` if it shows two patterns, one on the other.
Status see_filtered(const ImageView& image, const Options& options, Workspace& w);

/// Bits -> position in the profile of the options. `not_certain` where a closer look may help.
Status read_position(const Options& options, Workspace& w);

/// Where the position in doubt is right, a grid fitted to all dots that it has there shows the bits
/// more clearly: looks through one grid after the other. What was seen before is lost.
Status resample_until_certain(const ImageView& image, const Options& options, Workspace& w);

/// Position -> pose, and what other profiles make of the bits.
Status measure_and_weigh(const ImageView& image, const Options& options, Workspace& w);

}  // namespace dotpose::core
