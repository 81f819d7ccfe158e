// Uneven: what the distances of the dots from the fitted plane have in common. One plane explains a
// flat sheet; where neighbouring dots are off alike, the sheet is not flat, and the fix is not as
// exact as dots that scatter each by itself would make it. differs: the paper has one plane.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Looks for structure in what is left after the fit. Where a line divides the sheet, the plane is
/// fitted once more, to the dots on the reference point's side. Sets what `fit` knows of the paper.
void fit_uneven(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                FloatPlane& plane, PoseFit& fit);

/// The same for a plane that was fitted to observations; with memory for as many dots, otherwise
/// nothing is looked at.
void fit_uneven(const Kernels& kernels, const Observations& observations, Vec reference_q8,
                MeasuredDots& dots, PlaneFromImage& plane, PoseFit& fit);

}  // namespace dotpose::core
