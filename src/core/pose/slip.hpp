// Slip: a line that divides the sheet, beyond which the dots are displaced against the others:
// where a printer fed the paper badly, or two sheets are butted. differs: the paper has one plane.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// The line, in the pattern, and what lies beyond it.
struct Slip {
    /// Gains below the one are chance, and those above the other are not: so many lines are tried,
    /// each with three numbers for what is beyond, and sheets that slipped are few.
    static constexpr float kPossible = 8;
    static constexpr float kCertain = 23;

    FloatVec direction{1, 0};  ///< of unit length, from the reference point towards the line
    float distance = 0;        ///< of the reference point, spacings; below 0 beyond the line
    float gain = 0;            ///< by how much it explains the dots better, natural logarithm
};

/// The likeliest line, for dots that scatter so much about the plane.
Slip find_slip(const MeasuredDots& dots, const FloatPlane& plane, const PoseFit& fit,
               FloatVec reference_px);

}  // namespace dotpose::core
