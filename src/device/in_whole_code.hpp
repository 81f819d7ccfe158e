// Reads the bits of a frame as a place in the whole code.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

struct DeviceWorkspace;

/// Functions for the whole code. DeviceWorkspace calls these functions through a pointer. A program
/// whose frames are so small that only known sheets are read therefore does not contain them.
struct WholeCodeFunctions {
    /// Finds the place of a frame without a prediction, and verifies it. Sets the place and the
    /// orientation in the decoding (paper, section II-B.5-7).
    Status (*read)(const DeviceOptions& options, DeviceWorkspace& w);
    /// Verifies the predicted place of a tracked frame (see `verify_tracked`). Error: not_certain.
    Status (*verify)(const DeviceOptions& options, DeviceWorkspace& w);
};
extern const WholeCodeFunctions kWholeCodeFunctions;

}  // namespace dotpose::core
