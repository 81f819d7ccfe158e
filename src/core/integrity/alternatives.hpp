// Alternatives: the summed odds of all positions except the reading. Most of the sum comes from
// positions that share lines with the reading. likelihood_ratios.hpp defines the terms. See
// docs/integrity.md, "Alternatives: odds".
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns the summed odds of all alternatives except seam alternatives, accurate to 2 %. Each
/// alternative contributes its odds or an upper bound on its odds, except that some far
/// alternatives contribute their expected odds. The summation stops when the sum reaches
/// 2^limit_log2. A result of 2^limit_log2 or more may therefore be incomplete. Returns 1 if there
/// are at most 5 lines, or if the ratios come from hard bits.
float sum_of_alternatives(const Kernels& kernels, const LikelihoodRatios& ratios, int limit_log2);

/// Returns log2 of `sum_of_alternatives`, rounded up to an integer and clamped to at most 0.
int alternatives_log2(const Kernels& kernels, const LikelihoodRatios& ratios, int limit_log2 = 0);

}  // namespace dotpose::core
