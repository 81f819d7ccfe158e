// Seam alternatives: is a seam in view, between two sections that show the same place, a better
// explanation of the lines than the position found? docs/integrity.md derives it.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Summed odds of the positions that differ in one sequence and are seen with one shift up to a
/// border between two lines and with another one beyond it, as far as they explain the lines about
/// as well as the position found. In 2^-8 powers of two.
int seam_alternatives_log2_q8(const LikelihoodRatios& ratios);

/// The same sum, of which a desktop's kernels look for the alternatives.
int seam_alternatives_log2_q8(const Kernels& kernels, const LikelihoodRatios& ratios);

}  // namespace dotpose::core
