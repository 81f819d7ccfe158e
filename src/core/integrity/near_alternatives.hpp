// Near alternatives: positions that share several adjacent lines with the reading. See
// docs/integrity.md, "Alternatives: odds".
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of all alternatives that share at least `shared_lines`
/// (4 or 5) adjacent lines. Finds all places in each secondary sequence at which the 3 or 4 digits
/// between these lines occur, and enumerates their combinations. The sum contains the odds of an
/// alternative more than once if it shares more lines. Each combination contributes at least 2^-56.
float sum_of_near_alternatives(const Kernels& kernels, const RankedLines& lines, int shared_lines);

}  // namespace dotpose::core
