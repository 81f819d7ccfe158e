// Seam alternatives: the odds that the view contains a seam between two sections with the same
// positions, relative to the odds of the position read. docs/integrity.md derives the odds.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns log2 of the summed odds, including the prior probability of a seam, of the seam
/// alternatives that explain the lines about as well as the position read. The result is in units
/// of 2^-8, and kNever_q8 if there are no such alternatives. A seam alternative differs from the
/// position read in the place in one sequence. Its rolls have one shift before a border between two
/// lines, and another shift beyond the border.
int seam_alternatives_log2_q8(const LikelihoodRatios& ratios);

/// Returns the same sum, but uses kernels to search for the alternatives.
int seam_alternatives_log2_q8(const Kernels& kernels, const UnsharedLines& unshared);

}  // namespace dotpose::core
