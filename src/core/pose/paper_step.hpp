// Paper step: finds a line across which the print is displaced, for example because the printer fed
// the sheet unevenly or because two sheets meet. Unlike the paper, dotpose does not assume that all
// dots are in one plane.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// A line in the pattern that divides the sheet.
struct PaperStep {
    /// Thresholds for `gain`. On 1 in 100 flat sheets, the largest gain exceeds kPossible by
    /// chance. A gain above kCertain almost never occurs on a flat sheet. The thresholds are high
    /// because steps are rare, and because the search tries many lines and fits three parameters to
    /// each line.
    static constexpr float kPossible = 12;
    static constexpr float kCertain = 23;

    /// Unit normal of the line. It points to the part of the sheet that is called "beyond the
    /// line".
    FloatVec direction{1, 0};
    /// Distance from the reference point to the line, in spacings. Negative if the reference point
    /// is beyond the line.
    float distance = 0;
    /// Natural log of the likelihood ratio of two models: a sheet divided by this line, and a
    /// single plane.
    float gain = 0;
};

/// Returns the line with the largest gain. If no line has a positive gain, the `gain` of the result
/// is 0. `fit` is the result of fitting `plane` to the dots.
PaperStep find_paper_step(const MeasuredDots& dots, const FloatPlane& plane, const PoseFit& fit,
                          FloatVec reference_px);

}  // namespace dotpose::core
