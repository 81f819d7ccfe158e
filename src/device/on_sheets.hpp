// Reads the bits of a frame as a place on a known sheet.
#pragma once

#include "dotpose/device_options.hpp"

namespace dotpose::core {

struct DeviceWorkspace;

/// Functions for known sheets. DeviceWorkspace calls them through a pointer, so that a program
/// without known sheets does not contain them.
struct SheetFunctions {
    /// Finds the place and the orientation of the grid in a frame without a prediction. Returns
    /// false if no place on the sheets is certain.
    bool (*read)(const DeviceOptions& options, DeviceWorkspace& w);
    /// Returns true if the predicted place of a tracked frame is certain as a place on the sheets.
    bool (*verify)(const DeviceOptions& options, DeviceWorkspace& w);
};
extern const SheetFunctions kSheetFunctions;

}  // namespace dotpose::core
