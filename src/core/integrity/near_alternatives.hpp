// Near alternatives: positions that share several lines in a row with the one found.
// docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Summed odds of all that share that many consecutive lines, four or five, or more: one by one,
/// from the places in the secondary sequences at which the digits of the three or four differences
/// stand again. Upper bound: who shares more lines is counted more than once, and what is hopeless
/// as negligible.
float sum_of_near_alternatives(const RankedLines& lines, const code::Twins& twins,
                               int shared_lines);

}  // namespace dotpose::core
