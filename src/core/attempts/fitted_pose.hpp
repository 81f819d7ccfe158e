// The pose of the attempts that have floating point: fitted to all dots in view.
#pragma once

#include "core/pose/refine.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Position -> map from the image to the pattern. With an `image`, dots are measured in it once
/// more. Returns false when the dots do not determine it.
bool fit_pattern(const Options& options, const ImageView* image, Workspace& w, PoseFit& fit);

/// Position -> pose, likewise.
Status measure_pose(const Options& options, const ImageView* image, Workspace& w);

}  // namespace dotpose::core
