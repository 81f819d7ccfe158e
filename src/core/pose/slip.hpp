// Slip: a line that divides the sheet, beyond which the dots are displaced against the others: where
// a printer fed the paper badly, or two sheets are butted. differs: the paper has one plane.
#pragma once

#include "core/float_plane.hpp"
#include "core/pose/refine.hpp"

namespace dotpose::core {

/// The line, in the pattern, and what lies beyond it.
struct Slip {
    FloatVec direction{1, 0};  ///< of unit length, from the reference point towards the line
    float distance = 0;        ///< of the reference point, spacings; below 0 beyond the line
    float gain = 0;            ///< by how much it explains the dots better, natural logarithm
    FloatVec shift;            ///< of what is beyond, at the reference point, spacings
    float turn = 0;            ///< radians
    bool knows_shift = false;  ///< false: what is beyond is only known to be elsewhere
};

/// The likeliest line, for dots that scatter so much about the plane.
Slip find_slip(const MeasuredDots& dots, const FloatPlane& plane, const PoseFit& fit,
               FloatVec reference_px);

}  // namespace dotpose::core
