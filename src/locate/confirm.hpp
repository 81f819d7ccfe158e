// Confirm: shared by the attempts of desktops. Given where the pattern is thought to be, it
// measures the dots there, compares their bits with the code, and fits the pose.
#pragma once

#include "core/kernels/select.hpp"
#include "core/math/float_plane.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "locate/hypothesis.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Whether the grid may lie so in an image; the following steps rely on it.
bool is_plausible(const ImageView& image, const FloatPlane& plane);

/// Result of `confirm`.
enum class Confirmation : std::uint8_t {
    ok,
    implausible,  ///< the dots are not where they were expected
    uncertain,    ///< they are, but their bits leave doubts
    rough,        ///< they are, but far from their fitted places: see Hypothesis::defers_if_rough
};

/// Measures, compares and fits; a predicted hypothesis gets one look at each dot if that is enough.
/// Sets the workspace's fix and, if asked for, its trace.
Confirmation confirm(const Kernels& kernels, const ImageView& image, const Options& options,
                     Hypothesis hypothesis, DesktopWorkspace& w);

/// Returns true if the dots of a fix are so far from their fitted places that a second attempt may
/// be better.
bool is_rough(const Fix& fix);

}  // namespace dotpose::core
