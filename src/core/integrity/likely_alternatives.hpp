// Likely alternatives: the far alternatives that may have large odds. There are few of them, so
// they are found and counted one by one. See docs/integrity.md, "Alternatives: odds".
// likelihood_ratios.hpp defines the terms.
#pragma once

#include <optional>

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns the sum of the odds of all far alternatives. An alternative is likely if the minimum
/// losses of the lines that it does not share add up to less than a limit. The sum contains the
/// individual odds of each likely alternative. For all other far alternatives, it contains kMargin
/// times an upper bound on their expected odds. The limit is chosen such that this part is at most
/// `max_rest`. Stops when the odds of likely alternatives add up to more than `max_odds`. Returns
/// nullopt if the search would take too long.
std::optional<float> sum_of_likely_alternatives(const Kernels& kernels, const RankedLines& lines,
                                                float max_rest, float max_odds);

}  // namespace dotpose::core
