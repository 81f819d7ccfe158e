// Tabled alternatives: a bound of the odds of the alternatives in one sequence, by tables of how
// many of them leave how many lines unshared. Most sequences need not be looked at then.
#pragma once

#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {

/// Returns a bound of the odds of the alternatives that differ in one sequence and share a line,
/// each sequence by the table with the most lines that gives at most `enough`; `widest` is of the
/// table with the most. `sequences` has one in each bit: those for which no table does are not
/// counted, and stay in it.
float tabled_alternatives(const Kernels& kernels, const UnsharedLines& widest, float enough,
                          unsigned& sequences);

}  // namespace dotpose::core
