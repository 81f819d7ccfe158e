// Tabulated bounds: upper bounds on the odds of single alternatives, computed from tables of the
// maximum number of alternatives for each number of unshared lines. With these bounds, the
// alternatives of most sequences do not have to be enumerated. likelihood_ratios.hpp defines the
// terms.
#pragma once

#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of the single alternatives that share a line, in the
/// sequences whose bits are set in `sequences`. For each sequence, tries the tables in order of
/// decreasing number of lines, starting with the table that `widest` uses. If a bound is at most
/// `max_odds`, adds it to the sum and clears the bit of the sequence. The sum excludes sequences
/// whose bit remains set.
float tabled_alternatives(const Kernels& kernels, const UnsharedLines& widest, float max_odds,
                          unsigned& sequences);

}  // namespace dotpose::core
