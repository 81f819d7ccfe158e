// Minimum losses: lower bounds on the loss of every alternative. The bounds hold because an
// alternative shares at most `LikelihoodRatios::max_shared` adjacent lines. In most frames, these
// bounds show that no alternative matters.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Lower bounds on an alternative's loss in n adjacent lines at one end of the view, by n. Gains
/// count as 0.
using MinLosses = std::array<int, kMaxLines + 1>;
/// Returns the lower bounds for the first n lines, or for the last n lines if `from_last` is true.
MinLosses min_losses(const LikelihoodRatios& ratios, bool from_last);

/// Returns a lower bound on the loss of every seam alternative, over all borders. A seam
/// alternative has one shift before a border between two lines and another shift after it. Gains
/// count as 0.
int min_loss_with_border(const LikelihoodRatios& ratios);

/// Returns true if every seam alternative loses at least `loss_limit` in a single line. The test
/// looks for more than 2 * `max_shared` adjacent lines with such a minimum loss. An alternative
/// cannot share all these lines, because it shares at most `max_shared` adjacent lines before the
/// border and after it. Returns false if in doubt.
bool must_lose_with_border(const LikelihoodRatios& ratios, int loss_limit);

}  // namespace dotpose::core
