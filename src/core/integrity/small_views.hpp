// Small views: the probability that a position is wrong, in bounded work. See docs/integrity.md,
// "Small views". likelihood_ratios.hpp defines the terms.
#pragma once

#include <span>

#include "core/integrity/unshared_lines.hpp"
#include "core/integrity/work_limit.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns an upper estimate of the probability that the position is wrong because of alternatives
/// or seams, on one or two axes. `codes` is the weighted number of possible codes. Returns 1 if the
/// estimate exceeds `max_wrong`, or if `work` does not suffice. In most of these cases, returns
/// before the search for far alternatives.
float wrong_in_small_view(const Kernels& kernels, std::span<const UnsharedLines* const> axes,
                          float codes, float max_wrong, WorkLimit& work);

}  // namespace dotpose::core
