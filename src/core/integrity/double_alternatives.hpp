// Double alternatives: positions that differ from the reading in the places in two secondary
// sequences. docs/integrity.md derives the odds.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all double alternatives: 187,810 pairs of places, at all shifts. The
/// result is at least 2^-41. Requires at least 6 lines.
///
/// The anchors are the 12 lines with the most information, or all lines if there are fewer. Pairs
/// that share at least k anchors contribute their own odds. All other pairs contribute the
/// remainder: their expected odds times a safety factor. If the remainder exceeds `max_odds`, the
/// fix will be refused, so the function returns the remainder alone.
///
/// If the remainder exceeds `max_odds`, the fix will be refused. In this case, returns the
/// remainder without evaluating any pairs.
float sum_of_double_alternatives(const Kernels& kernels, const RankedLines& lines, float expected,
                                 float negligible, float max_odds);

}  // namespace dotpose::core
