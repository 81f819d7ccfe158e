// Planned alternatives: the far alternatives in small views, in bounded work. See
// docs/integrity.md, "Small views". likelihood_ratios.hpp defines the terms.
#pragma once

#include <optional>

#include "core/integrity/ranked_lines.hpp"
#include "core/integrity/set_plan.hpp"
#include "core/integrity/work_limit.hpp"

namespace dotpose::core {

/// Returns an upper estimate of the summed odds of all far alternatives. The result is the sum of
/// the individual odds of the alternatives in the first sets of the plan, and 4 times the expected
/// odds of all other far alternatives. The search ends as soon as the second term is at most
/// `share` times the difference between `max_odds` and the first term. Returns nullopt if the first
/// term exceeds `max_odds`, if the second term remains too large, or if `work` does not suffice.
std::optional<float> sum_of_planned_alternatives(const RankedLines& lines, const SetPlan& plan,
                                                 float share, float max_odds, WorkLimit& work);

/// Returns the work of `sum_of_planned_alternatives`, in processor instructions, if the second term
/// may be at most `max_rest`.
float work_of_planned_alternatives(const SetPlan& plan, float max_rest);

}  // namespace dotpose::core
