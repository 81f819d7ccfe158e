// The first attempt of a desktop: locates an image without a prediction, outwards from a patch.
#pragma once

#include "core/kernels/select.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Finds the grid in a part of the image, and then measures the dots of the whole image. Returns
/// true if there is a fix; the workspace has it. Otherwise the workspace's status is no_contrast,
/// too_few_dots, no_grid or, if the bits of the dots leave doubts, not_certain.
bool locate_first(const Kernels& kernels, const ImageView& image, const Options& options,
                  DesktopWorkspace& w);

}  // namespace dotpose::core
