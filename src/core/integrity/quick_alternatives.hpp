// Quick alternatives: computes an upper bound on the summed odds of all alternatives except seam
// alternatives, in integer arithmetic, for second attempts and devices. With many lines in view,
// this takes much less time than `wrong_by_alternatives`, and the bound is far below the accepted
// error probability, so no tighter bound is needed. See docs/integrity.md, "The quick bound".
// likelihood_ratios.hpp defines the terms.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Returns log2 of an upper bound on the summed odds of all alternatives except seam alternatives,
/// in units of 2^-8. The result is at most 0. `limit_q8` is the caller's limit on the error
/// probability, in the same unit. Returns 0 if the far alternatives and the other sections alone
/// reach this limit.
int quick_alternatives_log2_q8(const LikelihoodRatios& ratios, int limit_q8 = 0);

}  // namespace dotpose::core
