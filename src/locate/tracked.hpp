// The tracked attempt of a desktop: confirms a predicted pose.
#pragma once

#include "core/kernels/select.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Measures the dots where the prediction expects them. Returns false if the image does not confirm
/// it.
bool locate_tracked(const Kernels& kernels, const ImageView& image, const Options& options,
                    const Prediction& prediction, DesktopWorkspace& w);

/// Measures the dots of the workspace's fix, whose place is certain, again as exactly as those of a
/// prediction. If they do not confirm the fix, it stays as it is.
void measure_again(const Kernels& kernels, const ImageView& image, const Options& options,
                   DesktopWorkspace& w);

}  // namespace dotpose::core
