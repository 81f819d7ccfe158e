// Least losses: what every alternative loses, whichever it is, as none shares more lines in a row
// with the position found than `LikelihoodRatios::most_shared`. Most frames are told by it to have
// no alternative to fear.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// What is lost at least in the first n lines from one end of the view, for every n.
using OneSide = std::array<int, kMaxLines + 1>;
OneSide least_losses(const LikelihoodRatios& ratios, bool from_last);

/// What an alternative loses at least that shares lines at one shift before a border between two
/// lines and at another beyond it, wherever the border is.
int least_loss_with_border(const LikelihoodRatios& ratios);

/// Whether that is enough, told by one line alone: that which is lost of so many lines in a row,
/// each worth enough, that nobody shares them all, whatever the border. Says no where in doubt.
bool surely_lose_with_border(const LikelihoodRatios& ratios, int enough);

}  // namespace dotpose::core
