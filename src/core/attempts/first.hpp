// The first attempt of a desktop: image -> pose, outwards from a patch.
#pragma once

#include "core/kernels/select.hpp"
#include "core/workspace.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Locates from a patch of the image, then outwards. False if that does not settle it.
bool locate_outwards(const Kernels& kernels, const ImageView& image, const Options& options,
                     Workspace& w);

/// Whether it is asked for, and there is memory for it.
bool searches_outwards(const Options& options, const Workspace& w);

/// Locates from the blobs of all rows, and measures the dots once more where that is how they are
/// measured otherwise. Leaves the fix in the workspace; false if there is none.
bool locate_by_rows(const Kernels& kernels, const ImageView& image, const Options& options,
                    Workspace& w);

/// Outwards; what that does not settle, by rows.
Fix make_first_attempt(const ImageView& image, const Options& options, Workspace& w);

}  // namespace dotpose::core
