/// The simulated drive of the tests, followed with predictions as `dotpose watch` does it.
#pragma once

#include "counting.hpp"
#include "tracked_tally.hpp"

namespace dotpose {

/// At several speeds and frame rates.
TrackedTable drives_table(const Counting& counting);

}  // namespace dotpose
