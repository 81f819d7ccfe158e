// Tabled alternatives: upper bounds on the odds of single alternatives, from tables. The tables
// count alternatives by their number of unshared lines. With these bounds, most sequences need no
// enumeration.
#pragma once

#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of the single alternatives that share a line. Each bit
/// in `sequences` requests one sequence. For each sequence, tries the tables by decreasing number
/// of lines, from the table of `widest`. If a bound is at most `max_odds`, adds the bound and
/// clears the bit. Sequences whose bit remains set are not included.
float tabled_alternatives(const Kernels& kernels, const UnsharedLines& widest, float max_odds,
                          unsigned& sequences);

}  // namespace dotpose::core
