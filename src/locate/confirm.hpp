// Confirm: the common part of the first and the tracked attempt. Measures the dots of a hypothesis,
// compares their bits with the code, and fits the pose.
#pragma once

#include "core/kernels/select.hpp"
#include "core/math/float_plane.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "locate/hypothesis.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Returns true if the plane is plausible for a grid in the image. All stages that use a plane
/// require a plausible plane.
bool is_plausible(const ImageView& image, const FloatPlane& plane);

/// Result of `confirm`.
enum class Confirmation : std::uint8_t {
    ok,
    implausible,  ///< the dots are not at their expected places
    uncertain,    ///< the dots are at their expected places, but the position is not certain
};

/// Measures the dots of the hypothesis, compares their bits with the code, and fits the pose. If
/// the hypothesis is predicted and its spacing is suitable, first tries to sample the dots
/// directly. Sets the fix of the workspace and, if requested, its trace.
Confirmation confirm(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                     Hypothesis hypothesis, DesktopWorkspace& w);

/// Returns true if the residuals of a fix are so large that a second attempt may be better.
bool is_rough(const Fix& fix);

}  // namespace dotpose::core
