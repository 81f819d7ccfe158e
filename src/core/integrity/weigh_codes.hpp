// Weigh codes: the odds of places in the other codes, relative to the reading. The codes differ
// only in a4, so only positions with the same places in a1, a2 and a3 as the reading are compared.
// docs/integrity.md derives the sums.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"

namespace dotpose::core {

/// Returns the odds of the places in the code variant `other` along one axis, relative to the
/// reading. `ratios` are the likelihood ratios of the reading in the variant `read`.
OtherAxis weigh_other_code(const Kernels& kernels, const LikelihoodRatios& ratios, CodeVariant read,
                           CodeVariant other);

/// Sets the odds of the places in all codes other than `read`, along both axes.
void weigh_other_codes(const Kernels& kernels, const UnsharedLines& columns,
                       const UnsharedLines& rows, CodeVariant read, OtherCodes& others);

}  // namespace dotpose::core
