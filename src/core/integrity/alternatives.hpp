// Alternatives: the summed odds of all positions except the reading. Most of the sum comes from
// positions that share lines with the reading. likelihood_ratios.hpp defines the terms. See
// docs/integrity.md, "Alternatives: odds".
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns log2 of the summed odds of all alternatives except seam alternatives, rounded up to an
/// integer and clamped to at most 0. The odds of some far alternatives are expectations. All other
/// odds are exact or upper bounds. The sum is only as precise as a comparison with 2^limit_log2
/// requires. Returns 0 if there are at most 5 lines.
int alternatives_log2(const Kernels& kernels, const LikelihoodRatios& ratios, int limit_log2 = 0);

}  // namespace dotpose::core
