// Tabled alternatives: bounds the odds of the single alternatives of a sequence, from tables of the
// number of alternatives by their number of unshared lines. Most sequences then need no
// enumeration.
#pragma once

#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {

/// Returns a bound of the odds of the single alternatives that share a line. For each sequence,
/// uses the table with the most lines whose bound is at most `max_odds`. `widest` uses the table
/// with the most lines. `sequences` has one bit per sequence to be bounded. The bits of sequences
/// that no table bounds closely enough remain set, and the odds of these sequences are not
/// included.
float tabled_alternatives(const Kernels& kernels, const UnsharedLines& widest, float max_odds,
                          unsigned& sequences);

}  // namespace dotpose::core
