// Tabled alternatives: a bound of the odds of the single alternatives of a sequence, from tables of
// the number of alternatives by the number of lines that they leave unshared. Most sequences need
// no enumeration then.
#pragma once

#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {

/// Returns a bound of the odds of the single alternatives that share a line. Each sequence uses the
/// table with the most lines whose bound is at most `max_odds`. `widest` belongs to the table with
/// the most lines. `sequences` has a bit for each sequence to bound; the bits of those that no
/// table bounds closely enough remain set, and their odds are not included.
float tabled_alternatives(const Kernels& kernels, const UnsharedLines& widest, float max_odds,
                          unsigned& sequences);

}  // namespace dotpose::core
