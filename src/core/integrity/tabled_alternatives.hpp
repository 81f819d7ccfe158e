// Tabled alternatives: upper bounds on the odds of the single alternatives of a sequence, from
// tables that count the alternatives by their number of unshared lines. With these bounds, the
// alternatives of most sequences need not be enumerated.
#pragma once

#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of the single alternatives that share a line. Each bit
/// set in `sequences` requests the bound of one sequence. For each of these sequences, tries the
/// tables in order of decreasing number of lines, beginning with the table of `widest`. When a
/// bound is at most `max_odds`, adds the bound to the result and clears the bit. Sequences whose
/// bit is still set on return are not included in the result.
float tabled_alternatives(const Kernels& kernels, const UnsharedLines& widest, float max_odds,
                          unsigned& sequences);

}  // namespace dotpose::core
