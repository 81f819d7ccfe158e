/// Tracks the simulated drive of the tests as `dotpose watch` does.
#pragma once

#include "counting.hpp"
#include "tracked_tally.hpp"

namespace dotpose {

/// Returns the table of drives at several speeds and frame rates.
TrackedTable drives_table(const Counting& counting);

}  // namespace dotpose
