// Newest rows: the stored rows of a tracked frame.
#pragma once

#include "device/tracking.hpp"

namespace dotpose::core {

/// Number of rows that must be kept after the dots in the stored rows have been read: the rows of a
/// square around an intersection (see `kHalf_px`), plus one row above and one below.
inline constexpr int kRowsNeeded = 11;

/// Returns the stride of stored rows, in bytes: the width rounded up to a multiple of 4.
constexpr int stride_of(int width_px) {
    return (width_px + 3) & ~3;
}

/// Stores a row as image row `Tracking::rows_taken`, and increments `rows_taken`. The memory must
/// have room for this row.
void keep_row(const std::uint8_t* pixels, Tracking& tracking);

/// If the memory does not have room for `rows` more rows, discards all but the newest
/// kRowsNeeded rows.
void make_room(int rows, Tracking& tracking);

/// Returns row v of the image, which must be stored. Consecutive rows are one stride apart.
inline const std::uint8_t* kept_row(const Tracking& tracking, int v) {
    return tracking.rows.data() + (v - tracking.first_kept) * tracking.stride_px;
}

}  // namespace dotpose::core
