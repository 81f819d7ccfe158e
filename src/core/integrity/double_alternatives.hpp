// Double alternatives: positions that differ from the position read in the places in two secondary
// sequences. docs/integrity.md derives the odds.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all double alternatives: 190,027 pairs of places, at all shifts. The
/// result is at least 2^-41. The lines with the most information are the anchors. Pairs that share
/// a minimum number of anchors are counted one by one. All other pairs contribute their expected
/// odds, with a safety factor. The minimum number is the largest number, from 7 down to 5, for
/// which the expected odds are at most `negligible`. If there is none, the minimum is 4, 3 or 2
/// anchors, and the expected odds may be up to `max_odds` / 8. If the expected odds still exceed
/// `max_odds`, returns them without counting pairs, because the fix is refused in any case.
/// Requires at least 6 lines.
float sum_of_double_alternatives(const RankedLines& lines, float negligible, float max_odds);

}  // namespace dotpose::core
