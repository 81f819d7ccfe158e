// Seam alternatives: whether a seam in view, between two sections that show the same place,
// explains the lines better than the position found. docs/integrity.md derives it.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns the summed odds, as log2 in 2^-8, of the positions that differ in one sequence and are
/// seen at one shift up to a border between two lines and at another one beyond it. Only those that
/// explain the lines about as well as the position found are counted.
int seam_alternatives_log2_q8(const LikelihoodRatios& ratios);

/// Returns the same sum; kernels of the desktop look for the alternatives.
int seam_alternatives_log2_q8(const Kernels& kernels, const UnsharedLines& unshared);

}  // namespace dotpose::core
