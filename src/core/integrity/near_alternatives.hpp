// Near alternatives: positions that share several adjacent lines with the reading.
// docs/integrity.md derives the odds.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of near alternatives. They share at least
/// `shared_lines` (4 or 5) adjacent lines with the reading. For each run of `shared_lines` lines,
/// combines all places with the reading's digits. An alternative that shares a longer run is
/// counted more than once. A hopeless alternative (`LikelihoodRatios::is_hopeless`) contributes
/// kNegligible.
float sum_of_near_alternatives(const RankedLines& lines, int shared_lines);

}  // namespace dotpose::core
