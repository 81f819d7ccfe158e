// Device attempt: locates a frame, in integer arithmetic and bounded time, from the blobs detected
// while its rows arrived.
#pragma once

#include "device/workspace.hpp"
#include "dotpose/device_options.hpp"

namespace dotpose::core {

/// Finds the grid, the position and the pose of a frame from its blobs. Sets and returns the fix in
/// the workspace.
const Fix& finish_device_attempt(const DeviceOptions& options, DeviceWorkspace& w);

}  // namespace dotpose::core
