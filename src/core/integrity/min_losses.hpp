// Minimum losses: lower bounds on the loss of every alternative. An alternative shares at most
// `LikelihoodRatios::max_shared` adjacent lines. Any max_shared + 1 adjacent lines therefore
// contain at least one line that the alternative does not share. In most frames, these bounds prove
// that all alternatives are negligible. likelihood_ratios.hpp defines the terms.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Lower bounds on the loss of an alternative in the n lines at one end of the view, indexed by n.
/// Gains are treated as 0.
using MinLosses = std::array<int, kMaxLines + 1>;
/// Returns the lower bounds for the first n lines, or for the last n lines if `from_last` is true.
MinLosses min_losses(const LikelihoodRatios& ratios, bool from_last);

/// Returns a lower bound on the loss of every seam alternative, wherever its border is. A seam
/// alternative has one shift before a border between two lines, and a different shift after the
/// border. Gains are treated as 0.
int min_loss_with_border(const LikelihoodRatios& ratios);

/// Returns true if more than 2 * `max_shared` adjacent lines each have a minimum loss of at least
/// `loss_limit`. Every seam alternative then loses at least `loss_limit` in at least one of these
/// lines, because it shares at most `max_shared` adjacent lines on each side of its border.
bool must_lose_with_border(const LikelihoodRatios& ratios, int loss_limit);

}  // namespace dotpose::core
