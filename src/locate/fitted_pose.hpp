// Fitted pose: the pose of the attempts in floating point, fitted to all dots in view.
#pragma once

#include "core/pose/refine_pose.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Whether the position explains the frame badly: dots off their places, and contradicting bits.
/// Two patterns that overlap nearly in line can pass for a third one, which has the columns of the
/// one and the rows of the other: a quarter of its cells show no dot at the expected place, half of
/// the dots lie beside theirs, and so the typical displacement is too small. docs/integrity.md has
/// the numbers.
bool is_implausible(const PoseFit& fit, int bits, int bit_errors);

/// Measures the dots of the position found, and fits the map from the image to the pattern to them.
/// Returns false if the dots do not determine the map.
bool fit_pattern(const Options& options, const ImageView& image, DesktopWorkspace& w, PoseFit& fit);

/// Fits the map as `fit_pattern` does, and writes the pose. Errors: no_grid, not_certain.
Status measure_pose(const Options& options, const ImageView& image, DesktopWorkspace& w);

}  // namespace dotpose::core
