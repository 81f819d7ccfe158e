// Uneven: whether residuals of neighbouring dots agree. One plane explains a flat sheet; where
// neighbouring dots are off in common, the sheet is not flat and the fix is less exact than
// independent scatter would make it. differs: the paper has one plane.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Looks for structure in the residuals of the fit. Where a line divides the sheet, fits the plane
/// once more to the dots on the reference point's side. Sets `surface` and `uneven` of `fit`.
void fit_uneven(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                FloatPlane& plane, PoseFit& fit);

/// Does the same for a plane that was fitted to observations, and searches for a line at a much
/// lower scatter of the blocks, which takes longer. `dots` is memory for as many dots; if it is too
/// small, the surface counts as even.
void fit_uneven(const Kernels& kernels, const Observations& observations, Vec reference_q8,
                MeasuredDots& dots, PlaneFromImage& plane, PoseFit& fit);

}  // namespace dotpose::core
