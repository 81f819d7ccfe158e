// The tracked attempt of devices: dots are measured where a prediction expects them, as their rows
// come in, in integers and without a frame buffer.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// Starts a frame, whose size the workspace must have room for. Errors: not_tracked.
Status begin_device_tracked(int width_px, int height_px, const Options& options,
                            const Prediction& prediction, Workspace& w);

/// Takes the next row. Errors: not_tracked; further rows are ignored then.
Status push_tracked_row(const std::uint8_t* pixels, Workspace& w);

/// Ends the frame; the fix is that of the workspace, with the status not_tracked if a row had it.
const Fix& finish_device_tracked(const Options& options, Workspace& w);

}  // namespace dotpose::core
