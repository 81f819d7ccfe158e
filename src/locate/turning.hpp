// Turning: locates images of a rolling shutter in which the scene rotates while the rows are read.
#pragma once

#include "core/kernels/select.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "dotpose/prediction.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Returns true if the fix of a first or tracked attempt has large or correlated residuals that a
/// rotation during the readout may explain. Uses and changes the measured dots of the attempt.
bool shows_turn(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                DesktopWorkspace& w);

/// Searches a patch at the image centre for a grid and a rotation. Then removes the rotation from
/// the image, and measures the dots of the whole image. Returns true if a fix was found and its
/// rotation is significant. The workspace then contains the fix. Otherwise, restores the previous
/// fix.
bool locate_turning(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                    DesktopWorkspace& w);

/// Removes the predicted rotation from the image, and measures the dots at their predicted places.
/// Returns true if their bits confirm the prediction. The workspace then contains the fix.
bool locate_tracked_turning(const Kernels& kernels, const ImageView& image,
                            const DeviceOptions& options, const Prediction& prediction,
                            DesktopWorkspace& w);

}  // namespace dotpose::core
