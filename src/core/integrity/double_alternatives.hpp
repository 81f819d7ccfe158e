// Double alternatives: positions that differ from the reading in the places in two secondary
// sequences. docs/integrity.md derives the odds.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all double alternatives: 187,810 pairs of places, at all shifts. The
/// result is at least 2^-41. The anchors are the 12 lines with the most information, or all lines
/// if there are fewer than 12. Counts the pairs that share at least k anchors one by one. Adds the
/// remainder for all other pairs: their expected odds times a safety factor. k is the largest value
/// in [5, 7], and at most the number of lines, for which the remainder is at most `negligible`. If
/// there is no such value, k is the largest value in [2, 4] for which the remainder is at most
/// `max_odds` / 8. If there is no such value either, k is 2. If the remainder exceeds `max_odds`
/// even with this k, the fix will be refused, so the function returns the remainder without
/// counting any pairs. Requires at least 6 lines.
float sum_of_double_alternatives(const RankedLines& lines, float negligible, float max_odds);

}  // namespace dotpose::core
