// Minimum losses: lower bounds on the loss of every alternative. The bounds hold because no
// alternative shares more than `LikelihoodRatios::max_shared` adjacent lines with the reading. In
// most frames, these bounds show that no alternative matters.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Lower bounds on the loss of an alternative. Element n is the bound for n adjacent lines at one
/// end of the view. A gain in a line that another roll fits better counts as 0.
using MinLosses = std::array<int, kMaxLines + 1>;
/// Returns the bounds for the first n lines or, if `from_last` is true, for the last n lines.
MinLosses min_losses(const LikelihoodRatios& ratios, bool from_last);

/// Returns a lower bound on the loss of every seam alternative, over all borders between two lines.
/// A seam alternative shares lines at one shift before the border and at another shift beyond the
/// border. Gains count as 0.
int min_loss_with_border(const LikelihoodRatios& ratios);

/// Returns true if every seam alternative loses at least `loss_limit` in a single line. This is the
/// case if each of more than 2 * `max_shared` adjacent lines has a minimum loss of at least
/// `loss_limit`, because an alternative shares at most `max_shared` adjacent lines on each side of
/// the border. Returns false if in doubt.
bool must_lose_with_border(const LikelihoodRatios& ratios, int loss_limit);

}  // namespace dotpose::core
