// Confirm: the last step of the first and the tracked attempt. Measures the dots of a hypothesis,
// compares their bits with the code, and fits the pose.
#pragma once

#include "core/kernels/select.hpp"
#include "core/math/float_plane.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "locate/hypothesis.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Returns true if the plane is a plausible view of paper over the whole image (see
/// `is_within_reason`). All stages require a plausible plane.
bool is_plausible(const ImageView& image, const FloatPlane& plane);

/// Result of `confirm`.
enum class Confirmation : std::uint8_t {
    ok,
    implausible,   ///< the plane is not plausible, or the dots or their bits contradict the
                   ///< hypothesis
    uncertain,     ///< the hypothesis is plausible, but its position is not certain
    too_few_bits,  ///< same as `uncertain`, but all bits in view are clear and agree with the code
};

/// Tests a hypothesis: measures its dots, compares their bits with the code, and fits the pose.
/// Tries direct sampling first if the hypothesis is predicted and its dots allow it. If the result
/// is ok, sets the fix of the workspace and, if requested, the trace.
Confirmation confirm(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                     Hypothesis hypothesis, DesktopWorkspace& w);

/// Returns true if the residuals of a fix are large. A second attempt may then give a better fix.
bool is_rough(const Fix& fix);

}  // namespace dotpose::core
