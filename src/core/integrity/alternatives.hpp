// Alternatives: how probable it is that another position than the one found is the true one, such
// as one that shares some columns with it. docs/integrity.md derives the sums.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Returns log2 of an upper bound of the summed odds of all alternatives of a reading. The bound is
/// only as close as it takes to tell on which side of 2^limit_log2 the sum is.
int alternatives_log2(const LikelihoodRatios& ratios, int limit_log2 = 0);

}  // namespace dotpose::core
