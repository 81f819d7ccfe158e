// Tabled alternatives: upper bounds on the odds of the single alternatives of a sequence, from
// tables that count the alternatives by their number of unshared lines. Most sequences then need no
// enumeration.
#pragma once

#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {

/// Returns an upper bound on the odds of the single alternatives that share a line. For each
/// sequence, uses the table with the most lines whose bound is at most `max_odds`. `widest` uses
/// the table with the most lines. `sequences` has one bit per sequence to be bounded. A bit remains
/// set if no table gives a bound of at most `max_odds`. The odds of this sequence are not included
/// in the result.
float tabled_alternatives(const Kernels& kernels, const UnsharedLines& widest, float max_odds,
                          unsigned& sequences);

}  // namespace dotpose::core
