// Likely alternatives: the far alternatives that may have large odds. There are few of them, so
// they are found and counted one by one. See docs/integrity.md, "Alternatives: odds".
// likelihood_ratios.hpp defines the terms.
#pragma once

#include <optional>

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns an upper estimate of the summed odds of all far alternatives. An alternative is likely
/// if the minimum losses of the lines that it does not share add up to less than a limit. The
/// result contains the individual odds of each likely alternative. For all other far alternatives,
/// it contains kMargin times an upper bound on their expected odds. The limit is the smallest one
/// at which this part is at most `max_rest`, but at least 24 bits. If the odds of likely
/// alternatives add up to more than `max_odds`, the search stops and the result is incomplete, but
/// exceeds `max_odds`. Returns nullopt if the search would take too long, or if the limit would
/// have to be 100 bits or more.
std::optional<float> sum_of_likely_alternatives(const Kernels& kernels, const RankedLines& lines,
                                                float max_rest, float max_odds);

}  // namespace dotpose::core
