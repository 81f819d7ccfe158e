// The second attempt, for tilted cameras, lenses that bend, noise, uneven light and graphics.
#pragma once

#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Locates on the image filtered; bits are read from it rather than from blobs.
Fix make_second_attempt(const ImageView& image, const Options& options, Workspace& w);

}  // namespace dotpose::core
