// Double alternatives: positions whose places differ from those of the reading in two secondary
// sequences. See docs/integrity.md, "Alternatives: odds".
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all double alternatives: 187,810 pairs of places, at all shifts. The
/// result is at least 2^-41. Requires at least 6 lines.
///
/// Anchors are the lines with the most information, at most 12. The sum contains the individual
/// odds of the pairs that share at least k anchors. For all other pairs, the sum contains their
/// expected odds times kMargin. `expected` is the expected sum of the odds of all pairs.
///
/// k is chosen such that the expected part of the sum is at most 4 * `negligible`, unless the
/// search would take too long. If the expected part exceeds `max_odds`, the function returns it
/// without evaluating any pairs, because the caller refuses the fix.
float sum_of_double_alternatives(const Kernels& kernels, const RankedLines& lines, float expected,
                                 float negligible, float max_odds);

}  // namespace dotpose::core
