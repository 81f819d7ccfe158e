// Alternatives: estimates the probability that an alternative is correct rather than the reading,
// with a bounded amount of computation. See docs/integrity.md, "Alternatives: odds".
// likelihood_ratios.hpp defines the terms.
#pragma once

#include <span>

#include "core/integrity/unshared_lines.hpp"
#include "core/integrity/work_limit.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns an upper estimate of the probability that an alternative, rather than the reading, is
/// correct on at least one of the axes. Includes the seam alternatives. `axes` contains one or two
/// axes, and each axis must have more than kMaxShared lines. `codes` is the weighted number of
/// possible codes. Returns 1 if the estimate reaches `max_wrong`, or if it cannot be computed
/// within the work limit `work`. Usually, both cases are detected before the search for far
/// alternatives begins.
float wrong_by_alternatives(const Kernels& kernels, std::span<const UnsharedLines* const> axes,
                            float codes, float max_wrong, WorkLimit& work);

}  // namespace dotpose::core
