// Fine dots: finds the dots of a fine grid in the stored rows of a tracked frame. In fine grids, a
// dot is hardly larger than a pixel, so each dot has one darkest pixel.
#pragma once

#include "device/tracking.hpp"

namespace dotpose::core {

/// First row in which dots can be measured.
inline constexpr int kFirstFineRow = 2;

/// Adds the dots in the stored rows to `Tracking::fine_dots`, without those whose darkest pixel is
/// in the last two rows. Starts at `Tracking::next_reading`, and updates this row. If the memory
/// is full, ignores further dots.
void find_fine_dots(Tracking& tracking);

}  // namespace dotpose::core
