// Ring: the newest rows of a tracked frame, which is all that is kept of it.
#pragma once

#include "dotpose/stages.hpp"

namespace dotpose::core {

/// Rows are kept in whole words.
constexpr int stride_of(int width_px) {
    return (width_px + 3) & ~3;
}

void keep_row(const std::uint8_t* pixels, Tracking& tracking);

/// A row that is kept.
inline const std::uint8_t* kept_row(const Tracking& tracking, int v) {
    const int from_first = v - tracking.first_of_lap;
    return tracking.rows.data() +
           (from_first < 0 ? from_first + tracking.rows_kept : from_first) * tracking.stride_px;
}

}  // namespace dotpose::core
