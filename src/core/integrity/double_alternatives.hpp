// Double alternatives: positions that differ from the one found in the places of two secondary
// sequences. docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Summed odds of the 190,027 pairs of places at all shifts. Those that share several of the lines
/// that say most are looked at one by one, the others are counted at their expectation: so few are
/// looked at that an expectation of about `negligible` is left, and more where this would be more
/// than `most`. If it is nevertheless, none are: the sum is beyond `most` in any case. No less than
/// 2^-41. There must be 6 lines or more.
float sum_of_double_alternatives(const RankedLines& lines, float negligible, float most);

}  // namespace dotpose::core
