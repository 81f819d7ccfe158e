// Quick alternatives: an upper estimate of the summed odds of all alternatives that takes a
// thousandth of the work of `alternatives_log2`, and integers only. Where it is far below doubt,
// nobody needs to know more. docs/integrity.md derives it.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// In 2^-8 powers of two; 0 where so little work does not tell, or shows that it is above a limit.
int quick_alternatives_log2_q8(const LikelihoodRatios& ratios, int limit_q8 = 0);

}  // namespace dotpose::core
