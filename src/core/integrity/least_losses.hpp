// Least losses: what every alternative loses at least, as none shares more lines in a row with the
// position found than `LikelihoodRatios::most_shared`. For most frames this shows that no
// alternative matters.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// The least loss of score in the first n lines from one end of the view, for every n.
using OneSide = std::array<int, kMaxLines + 1>;
OneSide least_losses(const LikelihoodRatios& ratios, bool from_last);

/// Returns the least loss of an alternative that shares lines at one shift before a border between
/// two lines and at another shift beyond it, wherever the border is.
int least_loss_with_border(const LikelihoodRatios& ratios);

/// Returns whether every such alternative surely loses `enough` in one line: there are so many
/// lines in a row, each worth enough, that none shares them all, wherever the border is. Returns
/// false if in doubt.
bool surely_lose_with_border(const LikelihoodRatios& ratios, int enough);

}  // namespace dotpose::core
