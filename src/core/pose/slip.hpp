// Slip: a line that divides the sheet, beyond which the dots are displaced against the others:
// where a printer fed the paper badly, or two sheets are butted. differs: the paper has one plane.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// A line in the pattern that divides the sheet.
struct Slip {
    /// Gains below kPossible are chance: 1 in 100 flat sheets exceeds it. Those above kCertain are
    /// not. Both are high because many lines are tried, each with three parameters for the part
    /// beyond, and sheets that slipped are rare.
    static constexpr float kPossible = 12;
    static constexpr float kCertain = 23;

    FloatVec direction{1, 0};  ///< unit vector from the reference point towards the line
    float distance = 0;  ///< from the reference point to the line, spacings; negative beyond it
    float gain = 0;      ///< log likelihood ratio (natural) against one plane
};

/// Returns the likeliest line; `fit` tells how much the dots scatter about the plane.
Slip find_slip(const MeasuredDots& dots, const FloatPlane& plane, const PoseFit& fit,
               FloatVec reference_px);

}  // namespace dotpose::core
