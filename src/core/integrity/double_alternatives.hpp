// Double alternatives: positions that differ from the position read in the places of two secondary
// sequences. docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of the 190,027 pairs of places at all shifts, at least 2^-41. Pairs that
/// share several of the lines with the most information are counted one by one. All other pairs
/// contribute their expectation. The required number of shared lines is chosen such that this
/// expectation is about `negligible`, or at most `max_odds` if `negligible` takes too long. If the
/// expectation still exceeds `max_odds`, returns the expectation without counting pairs, because
/// the sum exceeds the limit anyway. Needs at least 6 lines.
float sum_of_double_alternatives(const RankedLines& lines, float negligible, float max_odds);

}  // namespace dotpose::core
