// Fitted pose: the pose of the second attempt, fitted to all dots in view.
#pragma once

#include "core/pose/refine_pose.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Returns true if the position does not explain the frame well: the displacement is not positive,
/// or
///
///     sqrt(variance) / displacement + bit_errors / bits > kMaxImplausible.
///
/// Two overlapping patterns that are nearly aligned can look like a third pattern, with the columns
/// of one pattern and the rows of the other. In such a frame, a quarter of the cells have no dot at
/// the expected place, and half of the dots are at another place of their cell. docs/integrity.md
/// contains the measurements.
bool is_implausible(const PoseFit& fit, int bits, int bit_errors);

/// Measures the dots that the code predicts at the decoded position, and fits the map from image to
/// pattern. Returns false if the dots do not determine the map.
bool fit_pattern(const DeviceOptions& options, const ImageView& image, DesktopWorkspace& w,
                 PoseFit& fit);

/// Calls `fit_pattern`, and writes the pose and its covariance into the fix. Errors: no_grid,
/// not_certain.
Status measure_pose(const DeviceOptions& options, const ImageView& image, DesktopWorkspace& w);

}  // namespace dotpose::core
