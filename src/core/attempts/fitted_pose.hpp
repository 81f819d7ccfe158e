// The pose of the attempts that have floating point: fitted to all dots in view.
#pragma once

#include "core/pose/refine_pose.hpp"
#include "core/workspace.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Whether the position explains badly what is seen: dots that are not where it has them, bits that
/// are others. Two patterns that lie on one another, nearly in line, can pass for a third one,
/// which has the columns of the one and the rows of the other: a quarter of its cells show no dot
/// at its place, half of the dots are beside theirs, and so the typical displacement comes out too
/// small. docs/integrity.md has the numbers.
bool is_implausible(const PoseFit& fit, int bits, int bit_errors);

/// Position -> map from the image to the pattern. With an `image`, dots are measured in it once
/// more. Returns false when the dots do not determine it.
bool fit_pattern(const Options& options, const ImageView* image, Workspace& w, PoseFit& fit);

/// Position -> pose, likewise.
Status measure_pose(const Options& options, const ImageView* image, Workspace& w);

}  // namespace dotpose::core
