// Fine dots: finds the dots in the stored rows of a frame by their darkest pixels. In fine grids
// and in small frames, a dot is hardly larger than a pixel, so each dot has one darkest pixel.
// Larger dots have one as well, because their edges are blurred.
#pragma once

#include "core/kernels/portable/dark_sums.hpp"
#include "device/tracking.hpp"

namespace dotpose::core {

/// First row in which dots can be measured.
inline constexpr int kFirstFineRow = 2;

/// Adds the dots in the stored rows to `Tracking::found`, except dots whose darkest pixel is in the
/// last two rows. Starts at row `Tracking::next_reading`, and updates this member. Ignores further
/// dots when the memory is full.
void find_fine_dots(Tracking& tracking);

/// Adds a dot to `Tracking::found`, unless the memory is full or the mass of the dot is too small.
/// `pixel` is the darkest pixel of the dot, and `sums` are the darkness sums around this pixel.
void add_fine_dot(FixedVec pixel, const DarkSums& sums, Tracking& tracking);

/// Removes the dots whose masses are far from the mean mass.
void drop_unlike_dots(Tracking& tracking);

}  // namespace dotpose::core
