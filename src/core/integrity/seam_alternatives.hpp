// Seam alternatives: the odds, relative to the reading, that the view contains a seam between two
// sections with the same positions. See docs/integrity.md, "Seams: odds with a prior".
// likelihood_ratios.hpp defines the terms.
#pragma once

#include <optional>

#include "core/integrity/likelihood_ratios.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/integrity/work_limit.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns log2 of the summed odds in units of 2^-8, including the prior probability of a seam. The
/// place of a seam alternative differs from that of the reading in one sequence, and its shift
/// changes at a border between two lines. Includes only alternatives whose odds, without the prior,
/// exceed 2^-8. Returns kNever_q8 if there are no such alternatives.
int seam_alternatives_log2_q8(const LikelihoodRatios& ratios);

/// Variant that uses kernels to search for the alternatives.
int seam_alternatives_log2_q8(const Kernels& kernels, const UnsharedLines& unshared);

/// Variant with a bounded amount of computation. Returns nullopt if the computation would exceed
/// the work limit `work`.
std::optional<int> seam_alternatives_log2_q8(const Kernels& kernels, const UnsharedLines& unshared,
                                             WorkLimit& work);

}  // namespace dotpose::core
