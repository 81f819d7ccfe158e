// Expected alternatives: the expected odds of positions whose places differ from those of the
// reading in several secondary sequences. The expectation is over all places. Enumerating the
// positions would take too long, because there are 4e8 of them. See docs/integrity.md,
// "Alternatives: odds".
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Safety factor for expected odds. The factor is necessary because the odds at a given position
/// can exceed the mean over all positions. On 5,630 axes of hard frames, the odds of double
/// alternatives were at most 21 times the mean.
inline constexpr float kMargin = 32;

/// Returns the expected total odds of the far alternatives that differ from the reading in
/// `min_different` to `max_different` sequences and share at most `max_shared` adjacent lines with
/// the reading.
float sum_of_expected_alternatives(const Kernels& kernels, const RankedLines& lines, int max_shared,
                                   int min_different, int max_different);

}  // namespace dotpose::core
