// Small frame: finds the dots of a small frame on known sheets. Such a frame contains only a few
// more dots than are needed to locate it, so dots close to the border or to each other must also be
// found. Blob detection (core/detect/blobs.hpp) misses these dots. The search for darkest pixels
// finds them, but requires that the rows are stored.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

struct DeviceWorkspace;

/// Maximum width and height of small frames, in px. At spacings of up to 15 px, larger frames show
/// enough dots for blob detection.
inline constexpr int kMaxSmallSide_px = 80;

/// Prepares the workspace to store the rows of a frame. Returns false if the frame is not small, or
/// if the memory has no room for all of its rows.
bool begin_small_frame(int width_px, int height_px, const DeviceOptions& options,
                       DeviceWorkspace& w);

/// Finds the dots in the stored rows. If rows are missing, the last stored row is treated as the
/// lower border of the image. Errors: no_contrast, too_few_dots.
Status find_dots_of_small_frame(const DeviceOptions& options, DeviceWorkspace& w);

}  // namespace dotpose::core
