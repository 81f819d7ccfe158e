/// Tests predictions with pairs of frames: the fix of the first frame gives the prediction for the
/// second.
#pragma once

#include "counting.hpp"
#include "tracked_tally.hpp"

namespace dotpose {

/// Returns the table of nominal frames with predictions of increasing error.
TrackedTable offsets_table(const Counting& counting, std::uint64_t frames);

/// Returns the table of second frames that differ from the first: other light, lifted, turned, put
/// elsewhere, covered.
TrackedTable changes_table(const Counting& counting, std::uint64_t frames);

}  // namespace dotpose
