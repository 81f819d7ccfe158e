// Fine dots: finds the dots in the stored rows of a frame by their darkest pixels. In fine grids
// and in small frames, a dot is hardly larger than a pixel, so each dot has one darkest pixel.
#pragma once

#include "core/kernels/portable/dark_sums.hpp"
#include "device/tracking.hpp"

namespace dotpose::core {

/// First row in which dots can be measured.
inline constexpr int kFirstFineRow = 2;

/// Adds the dots in the stored rows to `Tracking::found`, without those whose darkest pixel is
/// in the last two rows. Starts at `Tracking::next_reading`, and updates this row. If the memory
/// is full, ignores further dots.
void find_fine_dots(Tracking& tracking);

/// Adds a dot to `Tracking::found`, if there is memory left and its mass is not too small. `pixel`
/// is its darkest pixel, and `sums` are the sums around it.
void add_fine_dot(FixedVec pixel, const DarkSums& sums, Tracking& tracking);

/// Removes the dots whose masses are far from the mean mass.
void drop_unlike_dots(Tracking& tracking);

}  // namespace dotpose::core
