// Near alternatives: positions that share several adjacent lines with the reading. See
// docs/integrity.md, "Alternatives: odds". likelihood_ratios.hpp defines the terms.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of all alternatives that share at least `shared_lines`
/// adjacent lines with the reading. `shared_lines` must be 4 or 5. An alternative that shares more
/// adjacent lines is counted more than once. Each alternative contributes at least 2^-56.
float sum_of_near_alternatives(const Kernels& kernels, const RankedLines& lines, int shared_lines);

}  // namespace dotpose::core
