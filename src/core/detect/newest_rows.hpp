// Newest rows: all that is kept of a tracked frame.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Rows are kept in whole words.
constexpr int stride_of(int width_px) {
    return (width_px + 3) & ~3;
}

/// There must be room for it.
void keep_row(const std::uint8_t* pixels, Tracking& tracking);

/// Forgets those before the last `Tracking::rows_needed` where there is no room for so many more.
void make_room(int rows, Tracking& tracking);

/// A row that is kept; those after it follow.
inline const std::uint8_t* kept_row(const Tracking& tracking, int v) {
    return tracking.rows.data() + (v - tracking.first_kept) * tracking.stride_px;
}

}  // namespace dotpose::core
