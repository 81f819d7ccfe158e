// Uneven: tests the residuals of neighbouring dots for correlation. If they are correlated, the
// sheet is not flat, and the covariance of the fit is too small. Unlike the paper, dotpose does not
// assume that all dots are in one plane.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Returns true if `fit_uneven` would search for a line that divides the sheet: if the scatter
/// between blocks exceeds kSuspect, or if there are many outliers.
bool may_be_divided(const Kernels& kernels, const MeasuredDots& dots, const FloatPlane& plane,
                    const PoseFit& fit);

/// Tests the residuals of the fit for correlation. If the gain of a dividing line exceeds
/// PaperStep::kCertain, and the dots on the reference point's side of the line are in one plane,
/// refits the plane to these dots. Sets `surface` and `uneven` in `fit`.
void fit_uneven(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                FloatPlane& plane, PoseFit& fit);

/// Overload for a plane that was fitted to observations. It searches for a line even if the
/// correlation is much weaker, so it is slower than the overload above. `dots` provides memory for
/// the observations. If this memory is too small, skips the test and sets the surface to even.
void fit_uneven(const Kernels& kernels, const Observations& observations, FixedVec reference_q8,
                MeasuredDots& dots, PlaneFromImage& plane, PoseFit& fit);

}  // namespace dotpose::core
