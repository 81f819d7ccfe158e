// Double alternatives: positions that differ from the one found in the places of two secondary
// sequences. docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of the 190,027 pairs of places at all shifts, at least 2^-41. Pairs that
/// share several of the lines that say most are looked at one by one, the others counted at their
/// expectation. So many are looked at that an expectation of about `negligible` is left, and more
/// where it would exceed `most`; if it does all the same, none are, as the sum is beyond `most`
/// anyway. There must be 6 lines or more.
float sum_of_double_alternatives(const RankedLines& lines, float negligible, float most);

}  // namespace dotpose::core
