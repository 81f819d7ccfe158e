// Double alternatives: positions that differ from the reading in the places in two secondary
// sequences. docs/integrity.md derives the odds.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all double alternatives: 187,810 pairs of places, at all shifts. The
/// result is at least 2^-41. Requires at least 6 lines.
///
/// The anchors are the 12 lines with the most information, or all lines if there are fewer than 12.
/// Adds the odds of each pair of places that shares at least k anchors. For all other pairs, adds
/// the remainder: their expected odds times a safety factor. k is the first of these values that
/// exists:
/// - the largest value in [5, 7] for which the remainder is at most `negligible`. k is at most the
///   number of lines.
/// - the largest value in [2, 4] for which the remainder is at most `max_odds` / 8.
/// - 2.
///
/// If the remainder exceeds `max_odds`, the fix will be refused. In this case, returns the
/// remainder without evaluating any pairs.
float sum_of_double_alternatives(const Kernels& kernels, const RankedLines& lines, float expected,
                                 float negligible, float max_odds);

}  // namespace dotpose::core
