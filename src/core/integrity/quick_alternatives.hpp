// Quick alternatives: an upper estimate of the summed odds of all alternatives that takes a
// thousandth of the work of `alternatives_log2`, in integers only. For most frames it is far enough
// below the limit. docs/integrity.md derives it.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Returns the estimate as log2 in 2^-8, or 0 if so little work does not tell or shows that it is
/// above the limit.
int quick_alternatives_log2_q8(const LikelihoodRatios& ratios, int limit_q8 = 0);

}  // namespace dotpose::core
