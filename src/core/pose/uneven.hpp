// Uneven: tests the residuals of neighbouring dots for correlation. A single plane explains a flat
// sheet. If neighbouring dots have common residuals, the sheet is not flat, and the fix is less
// accurate than independent residuals suggest. Differs: the method of the paper fits a single
// plane.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Tests the residuals of the fit for correlation. If a line certainly divides the sheet and the
/// side of the reference point is even, fits the plane again to the dots on this side. Sets
/// `surface` and `uneven` of `fit`.
void fit_uneven(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                FloatPlane& plane, PoseFit& fit);

/// Overload for a plane that was fitted to observations. Starts to search for a line at a much
/// lower correlation than the other overload, so it takes longer. `dots` provides the memory for
/// the observations. If this memory is too small, the surface counts as even.
void fit_uneven(const Kernels& kernels, const Observations& observations, FixedVec reference_q8,
                MeasuredDots& dots, PlaneFromImage& plane, PoseFit& fit);

}  // namespace dotpose::core
