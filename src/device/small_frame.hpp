// Small frame: finds the dots of a small frame on known sheets. Such a frame has few more dots than
// needed, so its rows are stored, and dots are also found where they are close to the border or to
// each other. The detection of blobs (core/detect/blobs.hpp) loses these dots.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

struct DeviceWorkspace;

/// Maximum width and height of small frames. Grids of which they show enough dots have spacings of
/// up to 15 px.
inline constexpr int kMaxSmallSide_px = 80;

/// Starts to store the rows of a frame. Returns false if the frame is not small, or if the memory
/// has no room for all of its rows.
bool begin_small_frame(int width_px, int height_px, const DeviceOptions& options,
                       DeviceWorkspace& w);

/// Finds the dots in the stored rows. If rows are missing, the last stored row counts as the border
/// of the image. Errors: no_contrast, too_few_dots.
Status find_dots_of_small_frame(const DeviceOptions& options, DeviceWorkspace& w);

}  // namespace dotpose::core
