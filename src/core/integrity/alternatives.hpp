// Alternatives: the summed odds of all positions except the reading. Most of the sum comes from
// positions that share lines with the reading. likelihood_ratios.hpp defines the terms. See
// docs/integrity.md, "Alternatives: odds".
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns the summed odds of all alternatives except seam alternatives, accurate to 2 %. The odds
/// of some far alternatives are expectations. All other odds are exact or upper bounds. The sum is
/// only as precise as a comparison with 2^limit_log2 requires. Returns 1 or more if there are at
/// most 5 lines.
float sum_of_alternatives(const Kernels& kernels, const LikelihoodRatios& ratios, int limit_log2);

/// Returns log2 of this sum, rounded up to an integer and clamped to at most 0.
int alternatives_log2(const Kernels& kernels, const LikelihoodRatios& ratios, int limit_log2 = 0);

}  // namespace dotpose::core
