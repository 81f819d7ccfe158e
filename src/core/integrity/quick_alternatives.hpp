// Quick alternatives: computes an upper bound on the summed odds of all alternatives, in integers
// only. The bound takes a thousandth of the work of `alternatives_log2`. In most frames it is far
// below the limit. docs/integrity.md derives it.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Returns the bound as log2 in units of 2^-8, or 0 if the bound exceeds the limit.
int quick_alternatives_log2_q8(const LikelihoodRatios& ratios, int limit_q8 = 0);

}  // namespace dotpose::core
