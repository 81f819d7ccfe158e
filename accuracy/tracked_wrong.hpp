/// Predictions of places that are not in view.
#pragma once

#include "counting.hpp"
#include "tracked_tally.hpp"

namespace dotpose {

/// `predictions` in all, evenly over the classes.
TrackedTable wrong_predictions_table(const Counting& counting, std::uint64_t predictions);

}  // namespace dotpose
