// Near alternatives: positions that share several adjacent lines with the position read.
// docs/integrity.md derives the odds.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of all alternatives that share at least `shared_lines`
/// (4 or 5) adjacent lines. Counts the alternatives one by one, from the places in the secondary
/// sequences where the 3 or 4 digits between these lines occur again. Alternatives that share more
/// lines are counted more than once. Hopeless alternatives count with the odds kNegligible.
float sum_of_near_alternatives(const RankedLines& lines, int shared_lines);

}  // namespace dotpose::core
