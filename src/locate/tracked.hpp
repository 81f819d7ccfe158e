// Tracked: the tracked attempt. Locates an image near a predicted pose.
#pragma once

#include "core/kernels/select.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "dotpose/prediction.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Measures the dots at their predicted places. Returns true, and sets the fix of the workspace, if
/// their bits confirm the prediction.
bool locate_tracked(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                    const Prediction& prediction, DesktopWorkspace& w);

/// Measures the dots of the fix in the workspace again, as the tracked attempt does. The place of
/// the fix must be certain. If the dots do not confirm the fix, the fix remains unchanged.
void measure_again(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                   DesktopWorkspace& w);

}  // namespace dotpose::core
