// Single alternatives: positions that differ from the reading in the place in one secondary
// sequence. See docs/integrity.md, "Alternatives: odds".
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of all single alternatives that share a line with the
/// reading. The sum includes each alternative at every shift where it shares a line. Negligible
/// alternatives contribute an upper bound on their odds.
float sum_of_single_alternatives(const Kernels& kernels, const RankedLines& lines);

}  // namespace dotpose::core
