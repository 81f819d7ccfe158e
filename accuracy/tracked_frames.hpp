/// Pairs of frames: what was seen in the first predicts the second.
#pragma once

#include "counting.hpp"
#include "tracked_tally.hpp"

namespace dotpose {

/// Nominal frames with predictions that are off by more and more.
TrackedTable offsets_table(const Counting& counting, std::uint64_t frames);

/// Frames that are not as those before: other light, lifted, turned, put elsewhere, covered.
TrackedTable changes_table(const Counting& counting, std::uint64_t frames);

}  // namespace dotpose
