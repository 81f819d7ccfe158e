// Single alternatives: positions that differ from the one found in the place of one secondary
// sequence. docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Summed odds of all of them, one by one, with every shift at which they share some line with the
/// reading. Upper bound: what is hopeless is counted as negligible.
float sum_of_single_alternatives(const RankedLines& lines);

}  // namespace dotpose::core
