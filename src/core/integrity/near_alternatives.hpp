// Near alternatives: positions that share several adjacent lines with the reading.
// docs/integrity.md derives the odds.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of all alternatives that share at least `shared_lines`
/// (4 or 5) adjacent lines. For each run of `shared_lines` lines, combines the places in the four
/// secondary sequences that have the digits of the reading in all steps of the run. An alternative
/// that shares a longer run is included once for each run of `shared_lines` lines that it shares. A
/// hopeless alternative (`LikelihoodRatios::is_hopeless`) contributes kNegligible.
float sum_of_near_alternatives(const RankedLines& lines, int shared_lines);

}  // namespace dotpose::core
