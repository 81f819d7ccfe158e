// Likely alternatives: the far alternatives that may have large odds. They are counted one by one,
// because there are few of them. See docs/integrity.md, "Alternatives: odds". likelihood_ratios.hpp
// defines the terms.
#pragma once

#include <optional>

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns an upper estimate of the summed odds of all far alternatives. An alternative is likely
/// if the minimum losses of the lines that it does not share add up to less than a limit. The
/// result is the sum of two parts: the individual odds of the likely alternatives, and kMargin
/// times an upper bound on the expected odds of all other far alternatives. The limit is the
/// smallest value of at least 24 bits for which the second part is at most `max_rest`. If the first
/// part exceeds `max_odds`, the search stops. The result is then incomplete, but exceeds
/// `max_odds`. Returns nullopt if the search would take too long, or if the limit would have to be
/// 100 bits or more.
std::optional<float> sum_of_likely_alternatives(const Kernels& kernels, const RankedLines& lines,
                                                float max_rest, float max_odds);

}  // namespace dotpose::core
