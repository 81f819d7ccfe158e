// Small views: estimates the probability that a position is wrong, with a bounded amount of
// computation. See docs/integrity.md, "Small views". likelihood_ratios.hpp defines the terms.
#pragma once

#include <span>

#include "core/integrity/unshared_lines.hpp"
#include "core/integrity/work_limit.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns an upper estimate of the probability that an alternative, rather than the reading, is
/// correct on at least one of the axes. `axes` contains one or two axes. `codes` is the weighted
/// number of possible codes. Returns 1 if the estimate reaches `max_wrong`, or if it cannot be
/// computed within the work limit `work`. Usually, both cases are detected before the search for
/// far alternatives begins.
float wrong_in_small_view(const Kernels& kernels, std::span<const UnsharedLines* const> axes,
                          float codes, float max_wrong, WorkLimit& work);

}  // namespace dotpose::core
