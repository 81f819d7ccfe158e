// Double alternatives: positions that differ from the position read in the places in two secondary
// sequences. docs/integrity.md derives the odds.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all double alternatives: 187,810 pairs of places, at all shifts. The
/// result is at least 2^-41. The anchors are the lines with the most information, at most 12. Pairs
/// that share at least k anchors are counted one by one. All other pairs contribute the rest: their
/// expected odds, times a safety factor. k is the largest value in [5, 7], and at most the number
/// of lines, for which the rest is at most `negligible`. If there is none, k is the largest value
/// in [2, 4] for which the rest is at most `max_odds` / 8, or otherwise 2. If the rest exceeds
/// `max_odds` even then, the fix will be refused, so the function returns the rest without counting
/// any pairs. Requires at least 6 lines.
float sum_of_double_alternatives(const RankedLines& lines, float negligible, float max_odds);

}  // namespace dotpose::core
