// Expected alternatives: the expected odds of positions that differ from the reading in several
// secondary sequences. There are 4e8 such positions, too many to evaluate one by one. The odds are
// therefore averaged over all places. docs/integrity.md derives the expectation.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Safety factor for expected odds, which are means over all positions. The odds at a given
/// position can be larger. On 5,630 axes of hard frames, the odds of double alternatives were at
/// most 21 times the mean.
inline constexpr float kMargin = 32;

/// Returns the expected sum of the odds of the alternatives that differ from the reading in the
/// places in `min_different` to `max_different` sequences and share at most `max_shared` adjacent
/// lines with the reading.
float sum_of_expected_alternatives(const Kernels& kernels, const RankedLines& lines, int max_shared,
                                   int min_different, int max_different);

}  // namespace dotpose::core
