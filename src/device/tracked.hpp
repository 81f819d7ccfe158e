// Tracked: the tracked attempt on devices. Measures dots near their predicted centres while rows
// arrive. Uses integer arithmetic, and stores only the newest rows.
#pragma once

#include "device/workspace.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// Starts a frame. The frame must fit in the workspace. Error: not_tracked.
Status begin_device_tracked(int width_px, int height_px, const DeviceOptions& options,
                            const Prediction& prediction, DeviceWorkspace& w);

/// Processes the next row. Error: not_tracked. After an error, ignores further rows and returns the
/// error again.
Status push_tracked_row(const std::uint8_t* pixels, DeviceWorkspace& w);

/// Ends the frame. Sets and returns the fix in the workspace. The status is not_tracked if the dots
/// do not confirm the prediction, or if any row returned not_tracked.
const Fix& finish_device_tracked(const DeviceOptions& options, DeviceWorkspace& w);

}  // namespace dotpose::core
