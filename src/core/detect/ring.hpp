// Ring: the newest rows of a tracked frame, which is all that is kept of it.
#pragma once

#include "core/kernels/portable/dark_sums.hpp"
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

/// The square around a pixel; all of it is kept.
inline RingSquare square_around(const Tracking& tracking, int u, int v) {
    const int half = tracking.half_px;
    const std::int32_t bytes = tracking.rows_kept * tracking.stride_px;
    const std::uint8_t* const first = tracking.rows.data() + u - half;
    return {kept_row(tracking, v - half) + u - half, first + bytes, bytes, tracking.stride_px,
            half};
}

}  // namespace dotpose::core
