// Alternatives: the summed odds of all positions except the reading. Most of the sum comes from
// positions that share lines with the reading. likelihood_ratios.hpp defines the terms, and
// docs/integrity.md derives the sum.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Returns log2 of the summed odds, rounded up to an integer and at most 0. Includes all
/// alternatives except seam alternatives. Most far alternatives contribute expected odds. All other
/// odds are exact or upper bounds. The sum is only as precise as a comparison with 2^limit_log2
/// requires. Returns 0 if there are at most 5 lines.
int alternatives_log2(const LikelihoodRatios& ratios, int limit_log2 = 0);

}  // namespace dotpose::core
