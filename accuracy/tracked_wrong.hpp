/// Tests predictions of positions that are not in view.
#pragma once

#include "counting.hpp"
#include "tracked_tally.hpp"

namespace dotpose {

/// Returns the table of wrong predictions; their number is distributed evenly over the classes.
TrackedTable wrong_predictions_table(const Counting& counting, std::uint64_t predictions);

}  // namespace dotpose
