// Near alternatives: positions that share several lines in a row with the one found.
// docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all alternatives that share `shared_lines` consecutive lines, four or
/// five, or more: one by one, from the places in the secondary sequences at which the digits of the
/// three or four differences occur again. This is an upper bound, as those that share more lines
/// are counted more than once, and hopeless ones as negligible.
float sum_of_near_alternatives(const RankedLines& lines, int shared_lines);

}  // namespace dotpose::core
