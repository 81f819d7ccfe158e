// Whole code: finds and verifies the place of a frame in the whole code.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

struct DeviceWorkspace;

/// Functions that search the whole code. DeviceWorkspace calls them through a pointer, so they are
/// not linked into programs for small frames, which can be located only on known sheets.
struct WholeCodeFunctions {
    /// Finds and verifies the place of a frame that was begun without a prediction. Sets the place
    /// and the orientation in the decoding (paper, sections II-B.5 to II-B.7).
    Status (*read)(const DeviceOptions& options, DeviceWorkspace& w);
    /// Verifies the predicted place of a tracked frame (see `verify_tracked`). Error: not_certain.
    Status (*verify)(const DeviceOptions& options, DeviceWorkspace& w);
};
extern const WholeCodeFunctions kWholeCodeFunctions;

}  // namespace dotpose::core
