// The tracked attempt of devices: dots are measured where a prediction has them, as their rows come
// in, in integers and without the frame.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// Starts a frame of a size that the workspace has room for. Errors: not_tracked.
Status begin_device_tracked(int width_px, int height_px, const Options& options,
                            const Prediction& prediction, Workspace& w);

/// Errors: not_tracked; further rows make no difference then.
Status push_tracked_row(const std::uint8_t* pixels, Workspace& w);

const Fix& finish_device_tracked(const Options& options, Workspace& w);

}  // namespace dotpose::core
