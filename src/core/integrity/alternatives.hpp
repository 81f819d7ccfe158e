// Alternatives: the odds of all positions other than the position read, for example positions that
// share some columns with it. docs/integrity.md derives the sums.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Returns log2 of an upper bound on the summed odds of all alternatives, at most 0. The bound is
/// computed only precisely enough to compare the sum with 2^limit_log2.
int alternatives_log2(const LikelihoodRatios& ratios, int limit_log2 = 0);

}  // namespace dotpose::core
