// Single alternatives: positions that differ from the one found in the place of one secondary
// sequence. docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the summed odds of all single alternatives, one by one, at every shift at which they
/// share some line with the reading. This is an upper bound, as hopeless ones are counted as
/// negligible.
float sum_of_single_alternatives(const RankedLines& lines);

}  // namespace dotpose::core
