// Paper step: a line across which the sheet is displaced, because a printer fed the paper badly or
// two sheets are butted. differs: the paper has one plane.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// A line in the pattern that divides the sheet.
struct PaperStep {
    /// Gains below kPossible are explained by chance: 1 in 100 flat sheets exceeds it. Gains above
    /// kCertain are not. Both values are high because many lines are tried, each with three
    /// parameters for the part beyond, and because steps are rare.
    static constexpr float kPossible = 12;
    static constexpr float kCertain = 23;

    FloatVec direction{1, 0};  ///< unit vector from the reference point towards the line
    float distance = 0;  ///< distance from the reference point to the line, spacings; negative if
                         ///< the reference point is beyond it
    float gain = 0;      ///< log likelihood ratio (natural) against one plane
};

/// Returns the likeliest line. `fit` has the scatter of the dots about the plane.
PaperStep find_paper_step(const MeasuredDots& dots, const FloatPlane& plane, const PoseFit& fit,
                          FloatVec reference_px);

}  // namespace dotpose::core
