// Likely alternatives: the far alternatives that may have large odds. They are counted one by one,
// because there are few of them. See docs/integrity.md, "Alternatives: odds". likelihood_ratios.hpp
// defines the terms.
#pragma once

#include <optional>

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Returns an upper estimate of the summed odds of all far alternatives. An alternative is likely
/// if the minimum losses of its unshared lines add up to less than L. The estimate is the sum of
/// two terms:
/// - the individual odds of the likely alternatives,
/// - kMargin times an upper bound on the expected odds of all other far alternatives.
/// L is the smallest value, at least 24 bits, for which the second term is at most `max_rest`. The
/// search stops once the first term exceeds `max_odds`. In this case, the result also exceeds
/// `max_odds`, but is not an estimate of the sum. Returns nullopt if the search would take too
/// long, or if L would be 100 bits or more.
std::optional<float> sum_of_likely_alternatives(const Kernels& kernels, const RankedLines& lines,
                                                float max_rest, float max_odds);

}  // namespace dotpose::core
