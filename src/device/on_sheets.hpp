// Reads the bits of a frame as a place on a known sheet.
#pragma once

#include "dotpose/device_options.hpp"

namespace dotpose::core {

struct DeviceWorkspace;

/// Functions for known sheets. DeviceWorkspace calls them through a pointer, so that a program
/// without known sheets does not contain them.
struct SheetFunctions {
    /// Searches the known sheets for the grid of a frame without a prediction. If a place is
    /// certain, sets the place and the orientation in the decoding, and returns true. Otherwise
    /// returns false.
    bool (*read)(const DeviceOptions& options, DeviceWorkspace& w);
    /// Returns true if the predicted place of a tracked frame is on the known sheets and its bits
    /// make it certain (see `is_certain_place`).
    bool (*verify)(const DeviceOptions& options, DeviceWorkspace& w);
};
extern const SheetFunctions kSheetFunctions;

}  // namespace dotpose::core
