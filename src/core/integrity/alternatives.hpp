// Alternatives: the odds of all positions other than the position read, for example positions that
// share some columns with it. docs/integrity.md derives the sums.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Returns log2 of an upper bound of the summed odds of all alternatives, at most 0. The bound is
/// only as close as a comparison of the sum with 2^limit_log2 requires.
int alternatives_log2(const LikelihoodRatios& ratios, int limit_log2 = 0);

}  // namespace dotpose::core
