// Near alternatives: positions that share several adjacent lines with the position read.
// docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all alternatives that share at least `shared_lines` adjacent lines, 4
/// or 5. The alternatives are counted one by one, from the places in the secondary sequences at
/// which the 3 or 4 digits between these lines occur again. The result is an upper bound:
/// alternatives that share more lines are counted more than once, and hopeless alternatives count
/// as negligible.
float sum_of_near_alternatives(const RankedLines& lines, int shared_lines);

}  // namespace dotpose::core
