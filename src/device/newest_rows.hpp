// Newest rows: the only rows of a tracked frame that are kept.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Returns the distance between kept rows, which are whole words.
constexpr int stride_of(int width_px) {
    return (width_px + 3) & ~3;
}

/// Keeps a row; there must be room for it.
void keep_row(const std::uint8_t* pixels, Tracking& tracking);

/// Drops the rows before the newest `Tracking::rows_needed`, unless there is room for `rows` more.
void make_room(int rows, Tracking& tracking);

/// Returns a kept row; the following kept rows come after it in memory.
inline const std::uint8_t* kept_row(const Tracking& tracking, int v) {
    return tracking.rows.data() + (v - tracking.first_kept) * tracking.stride_px;
}

}  // namespace dotpose::core
