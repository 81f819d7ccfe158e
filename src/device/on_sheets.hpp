// Places on sheets: finds and verifies places on known sheets for a DeviceLocator.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

struct DeviceWorkspace;
struct Tracking;

/// Functions that search known sheets. DeviceWorkspace calls them through a pointer, so they are
/// not linked into programs that never set known sheets.
struct SheetFunctions {
    /// Searches the known sheets for the bits of a frame that was begun without a prediction. If a
    /// place is certain, sets the place and the orientation in the decoding, and returns true.
    /// Otherwise, returns false.
    bool (*read)(const DeviceOptions& options, DeviceWorkspace& w);
    /// Returns true if the predicted place of a tracked frame is on the known sheets and the bits
    /// of the frame make the place certain (see `is_certain_place`).
    bool (*verify)(const DeviceOptions& options, DeviceWorkspace& w);
    /// Prepares the workspace to store the rows of a small frame (see `begin_small_frame`).
    bool (*begin_small)(int width_px, int height_px, const DeviceOptions& options,
                        DeviceWorkspace& w);
    /// Finds the dots of a small frame (see `find_dots_of_small_frame`).
    Status (*find_dots_of_small)(const DeviceOptions& options, DeviceWorkspace& w);
    /// Finds the dots of a fine or deformed grid in the rows of a tracked frame (see
    /// `find_fine_dots`). Such grids are tracked only if sheets are known.
    void (*find_dots)(Tracking& tracking);
    /// Fits a fine grid and reads its bits. On success, sets `pattern_from_image` and the
    /// displacement in the fix, and returns the number of dots in the fit. Returns 0 on failure
    /// (see `fit_fine_grid`).
    int (*fit_grid)(const DeviceOptions& options, DeviceWorkspace& w);
};
extern const SheetFunctions kSheetFunctions;

}  // namespace dotpose::core
