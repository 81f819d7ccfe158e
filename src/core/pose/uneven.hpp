// Uneven: tests the residuals of neighbouring dots for correlation. If they are correlated, the
// sheet is not flat, and the covariance of the fit is too small. The paper assumes instead that all
// dots are in one plane.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Tests the residuals of the fit for correlation. If a line certainly divides the sheet, and the
/// reference point's side of the line is even, fits the plane again to this side. Sets `surface`
/// and `uneven` of `fit`.
void fit_uneven(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                FloatPlane& plane, PoseFit& fit);

/// Overload for a plane that was fitted to observations. It is slower, because it searches for a
/// line even if the correlation is much weaker. `dots` provides memory for the observations. If
/// this memory is too small, the surface counts as even.
void fit_uneven(const Kernels& kernels, const Observations& observations, FixedVec reference_q8,
                MeasuredDots& dots, PlaneFromImage& plane, PoseFit& fit);

}  // namespace dotpose::core
