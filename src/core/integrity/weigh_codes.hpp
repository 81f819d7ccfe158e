// Weigh codes: the odds of the places in the other codes that explain an axis about as well as the
// reading does. Codes differ in a4 only, so these places differ from the reading in a4 only.
// docs/integrity.md derives the sums.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"

namespace dotpose::core {

/// Returns, for one axis, the odds of the places in the code variant `other` relative to the
/// reading. `ratios` are the likelihood ratios of the reading in the variant `read`.
OtherAxis weigh_other_code(const Kernels& kernels, const LikelihoodRatios& ratios, CodeVariant read,
                           CodeVariant other);

/// Sets the odds of the places in all other codes, from the ratios of both axes.
void weigh_other_codes(const Kernels& kernels, const UnsharedLines& columns,
                       const UnsharedLines& rows, CodeVariant read, OtherCodes& others);

}  // namespace dotpose::core
