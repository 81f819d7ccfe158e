// The first attempt of a desktop: image -> pose, outwards from a patch.
#pragma once

#include "core/kernels/select.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Locates from a patch of the image, then outwards. False if that does not settle it.
bool locate_outwards(const Kernels& kernels, const ImageView& image, const Options& options,
                     Workspace& w);

/// The same; what it does not settle is located from the blobs of all rows.
Fix make_first_attempt(const ImageView& image, const Options& options, Workspace& w);

}  // namespace dotpose::core
