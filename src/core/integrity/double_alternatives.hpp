// Double alternatives: positions whose places differ from those of the reading in two secondary
// sequences. See docs/integrity.md, "Alternatives: odds". likelihood_ratios.hpp defines the terms.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all double alternatives: 187,810 pairs of places, at all shifts. The
/// result is at least 2^-41. Requires at least 6 lines.
///
/// Anchors are the lines with the most information. There are at most 12 anchors. The function
/// chooses a number k, and adds the individual odds of the pairs that share at least k anchors. For
/// all other pairs, it adds their expected odds times kMargin, called the expected part. `expected`
/// is the total of the expected odds of all pairs.
///
/// A smaller k reduces the expected part, but the search for the pairs takes longer. Normally, the
/// expected part is at most 4 * `negligible`. If this would require k < 4, an expected part of up
/// to `max_odds` / 8 is accepted instead, and k is at least 2. If the expected part exceeds
/// `max_odds` even then, the function returns the expected part without evaluating any pairs,
/// because the caller then rejects the fix.
float sum_of_double_alternatives(const Kernels& kernels, const RankedLines& lines, float expected,
                                 float negligible, float max_odds);

}  // namespace dotpose::core
