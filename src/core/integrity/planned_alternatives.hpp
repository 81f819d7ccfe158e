// Planned alternatives: sums the odds of the far alternatives, with a bounded amount of
// computation. See docs/integrity.md, "Far alternatives". likelihood_ratios.hpp defines the terms.
#pragma once

#include <optional>

#include "core/integrity/loss_tables.hpp"
#include "core/integrity/set_plan.hpp"
#include "core/integrity/work_limit.hpp"

namespace dotpose::core {

/// Returns an upper estimate of the summed odds of all far alternatives. The estimate has two
/// terms: the summed odds of the alternatives found so far, and 4 times the expected odds of all
/// other far alternatives. The function searches the sets of the plan, which must be complete, in
/// order, and the second term decreases with each set. After all required sets, the search ends as
/// soon as the second term is at most 2^(-31 - extra_bits) and at most `fraction` times the
/// difference between `max_odds` and the first term. Negligible odds are rounded up, by less if
/// `extra_bits` is larger (see `extra_bits_for`). Returns nullopt if:
/// - the first term exceeds `max_odds`,
/// - the second term remains too large after all sets, or
/// - the search would exceed its work limit `work`.
std::optional<float> sum_of_planned_alternatives(const LossTables& lines, const SetPlan& plan,
                                                 int extra_bits, float fraction, float max_odds,
                                                 WorkLimit& work);

/// Returns the estimated cost, in units of `WorkLimit`, of searching until the second term of
/// `sum_of_planned_alternatives` is at most `max_rest`.
float work_of_planned_alternatives(const SetPlan& plan, float max_rest);

}  // namespace dotpose::core
