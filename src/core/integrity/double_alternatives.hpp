// Double alternatives: positions that differ from the reading in the places in two secondary
// sequences. See docs/integrity.md, "Alternatives: odds".
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all double alternatives: 187,810 pairs of places, at all shifts. The
/// result is at least 2^-41. Requires at least 6 lines.
///
/// Anchors are the 12 lines with the most information, or all lines if there are fewer. The sum
/// contains the individual odds of the pairs that share at least k anchors. For all other pairs,
/// the sum contains their expected odds times kMargin. `expected` is the expected sum of the odds
/// of all pairs. The function chooses k such that the expected part is at most `negligible`, if
/// this does not take too long. If the expected part exceeds `max_odds`, the caller refuses the
/// fix. In this case, the function returns the expected part alone, without evaluating any pairs.
float sum_of_double_alternatives(const Kernels& kernels, const RankedLines& lines, float expected,
                                 float negligible, float max_odds);

}  // namespace dotpose::core
