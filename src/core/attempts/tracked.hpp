// The tracked attempt of a desktop: from where the pattern is expected to its pose.
#pragma once

#include "core/kernels/select.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Measures the dots where the prediction has them. False if the image does not bear it out.
bool locate_tracked(const Kernels& kernels, const ImageView& image, const Options& options,
                    const Prediction& prediction, Workspace& w);

}  // namespace dotpose::core
