// The attempt of devices: rows come in one by one, everything is integers, and the time is bounded.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Locates from the blobs of a frame.
const Fix& finish_device_attempt(const Options& options, Workspace& w);

}  // namespace dotpose::core
