// Confirm: the common part of the first and the tracked attempt. Given a hypothesis, measures its
// dots, compares their bits with the code, and fits the pose.
#pragma once

#include "core/kernels/select.hpp"
#include "core/math/float_plane.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "locate/hypothesis.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Returns true if a grid in an image may have this plane. The following steps rely on it.
bool is_plausible(const ImageView& image, const FloatPlane& plane);

/// Result of `confirm`.
enum class Confirmation : std::uint8_t {
    ok,
    implausible,  ///< the dots are not at their expected places
    uncertain,    ///< the dots are there, but their bits leave doubts
};

/// Measures, compares and fits. If the hypothesis is predicted, each dot is sampled directly first,
/// where that is possible. Sets the fix of the workspace and, if requested, its trace.
Confirmation confirm(const Kernels& kernels, const ImageView& image, const Options& options,
                     Hypothesis hypothesis, DesktopWorkspace& w);

/// Returns true if the dots of a fix are so far from their fitted places that a second attempt may
/// be better.
bool is_rough(const Fix& fix);

}  // namespace dotpose::core
