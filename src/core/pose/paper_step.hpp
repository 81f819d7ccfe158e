// Paper step: finds a line beyond which the print is displaced, because a printer fed the paper
// badly or because two sheets adjoin at the line. Differs: the method of the paper fits a single
// plane.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// A line in the pattern that divides the sheet.
struct PaperStep {
    /// Limits of `gain`. On 1 in 100 flat sheets, the gain exceeds kPossible by chance. A gain
    /// above kCertain is not due to chance. Both limits are high because many lines are tried, each
    /// with three parameters for the part beyond the line, and because steps are rare.
    static constexpr float kPossible = 12;
    static constexpr float kCertain = 23;

    FloatVec direction{1, 0};  ///< unit vector perpendicular to the line, pointing beyond the line
    /// Distance from the reference point to the line, in spacings. Negative if the reference point
    /// is beyond the line.
    float distance = 0;
    float gain = 0;  ///< log likelihood ratio (natural) relative to a single plane
};

/// Returns the line with the largest gain among the lines that are tried. If no line has a positive
/// gain, the gain of the result is 0. `fit` is the result of the fit of `plane`.
PaperStep find_paper_step(const MeasuredDots& dots, const FloatPlane& plane, const PoseFit& fit,
                          FloatVec reference_px);

}  // namespace dotpose::core
