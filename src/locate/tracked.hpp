// Tracked attempt: locates an image near a predicted pose. Unlike the paper, this attempt measures
// the dots only where a prediction expects them.
#pragma once

#include "core/kernels/select.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "dotpose/prediction.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Measures the dots at their predicted places. If their bits confirm the prediction, sets the fix
/// of the workspace and returns true.
bool locate_tracked(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                    const Prediction& prediction, DesktopWorkspace& w);

/// Measures the dots of the fix in the workspace again, as the tracked attempt does. The fix must
/// be certain. It remains unchanged if the dots do not confirm it.
void measure_again(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                   DesktopWorkspace& w);

}  // namespace dotpose::core
