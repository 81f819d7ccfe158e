// Planned alternatives: the far alternatives in small views, in bounded work. See
// docs/integrity.md, "Small views". likelihood_ratios.hpp defines the terms.
#pragma once

#include <optional>

#include "core/integrity/ranked_lines.hpp"
#include "core/integrity/work_limit.hpp"

namespace dotpose::core {

/// Returns an upper estimate of the summed odds of all far alternatives. The result is the sum of
/// the individual odds of the alternatives in the sets of lines that `SetPlan` chooses, and 4 times
/// the expected odds of all other far alternatives. The second term is at most `max_rest`. If the
/// sum exceeds `max_odds`, the search stops and the result is incomplete, but exceeds `max_odds`.
/// Returns nullopt if `work` does not suffice. In most of these cases, no set is searched.
std::optional<float> sum_of_planned_alternatives(const RankedLines& lines, float max_rest,
                                                 float max_odds, WorkLimit& work);

}  // namespace dotpose::core
