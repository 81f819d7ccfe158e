// Seam alternatives: the odds that the view contains a seam between two sections with the same
// positions, relative to the odds of the reading. docs/integrity.md derives the odds.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns log2 of the summed odds of the seam alternatives that explain the lines about as well as
/// the reading, in units of 2^-8. The odds include the prior probability of a seam. Returns
/// kNever_q8 if there are no such alternatives. A seam alternative differs from the reading in the
/// place in one sequence. The alternative has one shift before a border between two lines, and
/// another shift beyond the border.
int seam_alternatives_log2_q8(const LikelihoodRatios& ratios);

/// Returns the same sum, but uses kernels to search for the alternatives.
int seam_alternatives_log2_q8(const Kernels& kernels, const UnsharedLines& unshared);

}  // namespace dotpose::core
