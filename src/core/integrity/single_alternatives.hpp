// Single alternatives: positions that differ from the position read in the place of one secondary
// sequence. docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all single alternatives, counted one by one at every shift at which
/// they share a line with the reading. The result is an upper bound, because hopeless alternatives
/// count as negligible.
float sum_of_single_alternatives(const RankedLines& lines);

}  // namespace dotpose::core
