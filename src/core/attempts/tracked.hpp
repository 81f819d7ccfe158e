// The tracked attempt of a desktop: from where the pattern is expected to its pose.
#pragma once

#include "core/kernels/select.hpp"
#include "core/workspace.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// Measures the dots where the prediction has them. False if the image does not bear it out.
bool locate_tracked(const Kernels& kernels, const ImageView& image, const Options& options,
                    const Prediction& prediction, Workspace& w);

/// Measures the dots once more where the workspace's fix, which is certain of its place, has them,
/// as exactly as dots are that were predicted. Leaves the fix as it is where they do not bear it
/// out.
void measure_again(const Kernels& kernels, const ImageView& image, const Options& options,
                   Workspace& w);

}  // namespace dotpose::core
