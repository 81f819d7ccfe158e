// Minimum losses: lower bounds on the loss of every alternative. No alternative shares more
// adjacent lines with the position read than `LikelihoodRatios::max_shared`. In most frames, these
// bounds show that no alternative matters.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Minimum loss in the first n lines from one end of the view, for each n.
using MinLosses = std::array<int, kMaxLines + 1>;
MinLosses min_losses(const LikelihoodRatios& ratios, bool from_last);

/// Returns the minimum loss of an alternative that shares lines at one shift before a border
/// between two lines and at another shift beyond the border, over all borders.
int min_loss_with_border(const LikelihoodRatios& ratios);

/// Returns true if every alternative of `min_loss_with_border` loses `loss_limit` in a single line.
/// This is the case if a run of adjacent lines that each lose at least `loss_limit` is longer than
/// the runs that an alternative can share on both sides of a border. Returns false if in doubt.
bool must_lose_with_border(const LikelihoodRatios& ratios, int loss_limit);

}  // namespace dotpose::core
