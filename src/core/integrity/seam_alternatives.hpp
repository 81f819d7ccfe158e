// Seam alternatives: the odds that a seam in view, between two sections with the same positions,
// explains the lines better than the position read. docs/integrity.md derives them.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns the summed odds, as log2 in units of 2^-8, of the positions that differ from the
/// position read in one sequence, at one shift before a border between two lines and at another
/// shift beyond the border. Only positions that explain the lines about as well as the position
/// read are counted.
int seam_alternatives_log2_q8(const LikelihoodRatios& ratios);

/// Returns the same sum, but uses kernels to search for the alternatives.
int seam_alternatives_log2_q8(const Kernels& kernels, const UnsharedLines& unshared);

}  // namespace dotpose::core
