// Alternatives: how probable is it that another position than the one found, one that shares some
// columns with it, is the true one? docs/integrity.md derives the sums.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Upper bound, as a power of two, of the summed odds of all alternatives of a reading. No closer
/// than it takes to tell on which side of 2^limit_log2 they are.
int alternatives_log2(Profile profile, const LikelihoodRatios& ratios, int limit_log2 = 0);

}  // namespace dotpose::core
