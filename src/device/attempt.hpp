// The attempt of devices: rows come in one by one, all arithmetic is in integers, and the time is
// bounded.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Locates a frame from its blobs; the fix is that of the workspace.
const Fix& finish_device_attempt(const Options& options, Workspace& w);

}  // namespace dotpose::core
