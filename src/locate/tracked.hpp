// Tracked attempt: locates an image near a predicted pose. Unlike the paper, this attempt measures
// the dots only near their predicted positions.
#pragma once

#include "dotpose/prediction.hpp"
#include "locate/confirm.hpp"
#include "locate/frame.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Measures the dots at their predicted image positions. If their bits confirm the prediction, sets
/// the fix in the workspace and returns true.
bool locate_tracked(const Frame& frame, const Prediction& prediction, DesktopWorkspace& w);

/// Variant of `locate_tracked` that uses only the given parts of the workspace. Does not reset the
/// fix first, and stores no trace.
bool confirm_prediction(const Frame& frame, const Prediction& prediction,
                        const PlaceEvidence& evidence, Measurement& measurement, Fix& fix);

/// Measures the dots of a fix again, as the tracked attempt does, and updates the fix. The position
/// of the fix must be certain, because it is not tested again. If the dots do not confirm the fix,
/// returns false and leaves the fix unchanged.
bool measure_again(const Frame& frame, const PlaceEvidence& evidence, Measurement& measurement,
                   Fix& fix);

}  // namespace dotpose::core
