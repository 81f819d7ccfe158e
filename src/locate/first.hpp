// First attempt: locates an image without a prediction. Unlike the paper, this attempt finds the
// grid in a part of the image, starting with a patch around the image centre.
#pragma once

#include "locate/frame.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Finds the grid in a part of the image, then measures the dots of the whole image. If there is a
/// fix, stores it in the workspace and returns true. Otherwise, sets the status to no_contrast,
/// too_few_dots, no_grid or not_certain.
bool locate_first(const Frame& frame, DesktopWorkspace& w);

}  // namespace dotpose::core
