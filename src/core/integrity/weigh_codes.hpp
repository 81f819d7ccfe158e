// Weigh codes: computes the odds of places in the other codes, relative to the reading. The paper
// uses only one code, but dotpose supports sheets whose code is unknown. The codes differ only in
// a4. Only positions whose places in a1, a2 and a3 equal those of the reading are compared with the
// bits. The remaining positions in each code are assumed to have the same total odds as the
// corresponding positions in the code of the reading (see `OtherCodes::log2_in_question_q8`). See
// docs/integrity.md, "Which code?".
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"

namespace dotpose::core {

/// Returns the odds of the code `other` along one axis, relative to the reading in the code `read`.
/// `ratios` are the likelihood ratios of the reading.
OtherAxis weigh_other_code(const Kernels& kernels, const LikelihoodRatios& ratios, CodeVariant read,
                           CodeVariant other);

/// Sets the odds of all codes except `read`, along both axes.
void weigh_other_codes(const Kernels& kernels, const UnsharedLines& columns,
                       const UnsharedLines& rows, CodeVariant read, OtherCodes& others);

}  // namespace dotpose::core
