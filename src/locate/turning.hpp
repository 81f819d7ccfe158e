// Turning: locates rolling-shutter images of scenes that rotate during the readout.
#pragma once

#include <cstdint>
#include <span>

#include "core/math/readout_turn.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/prediction.hpp"
#include "locate/confirm.hpp"
#include "locate/frame.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Returns true if the fix of a first or tracked attempt has large or correlated residuals that a
/// rotation during the readout may explain. Returns false if `pixels` has no room for the derotated
/// image. `measurement` must contain the results of the attempt. Modifies the dots in
/// `measurement`. If the rotation can be fitted to these dots, sets `turn` to this rotation, and
/// the plane of `measurement.hypothesis` to the plane without it. Otherwise, sets `turn` to no
/// rotation.
bool shows_turn(const Frame& frame, const Fix& fix, std::span<const std::uint8_t> pixels,
                Measurement& measurement, ReadoutTurn& turn);

/// Finds the rotation of the scene, removes it from the image, and measures the dots of the whole
/// image. If this leads to a fix with a significant rotation, stores the fix in the workspace and
/// returns true. Otherwise, restores the previous fix and returns false.
///
/// If `turn` is not 0, it must be the rotation that `shows_turn` has fitted to the dots of the last
/// attempt. It is tried first, with the hypothesis in `w.measurement`. Otherwise, or if this does
/// not lead to a fix, searches a patch at the image centre for a grid and a rotation.
bool locate_turning(const Frame& frame, const ReadoutTurn& turn, DesktopWorkspace& w);

/// Removes the predicted rotation from the image, and measures the dots at their predicted
/// positions. If their bits confirm the prediction, stores the fix in the workspace and returns
/// true. Returns false if the bits do not confirm the prediction, if the rotation is out of range,
/// or if the workspace has no room for the derotated image.
bool locate_tracked_turning(const Frame& frame, const Prediction& prediction, DesktopWorkspace& w);

}  // namespace dotpose::core
