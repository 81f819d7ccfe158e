// The attempt of devices: processes one row at a time, in integers and in bounded time.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/device_options.hpp"

namespace dotpose::core {

/// Locates a frame from its blobs. Sets and returns the fix of the workspace.
const Fix& finish_device_attempt(const DeviceOptions& options, Workspace& w);

}  // namespace dotpose::core
