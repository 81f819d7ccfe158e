#include "device/newest_rows.hpp"

#include <cstring>

namespace dotpose::core {

void keep_row(const std::uint8_t* pixels, Tracking& tracking) {
    std::memcpy(
        tracking.rows.data() + (tracking.rows_taken - tracking.first_kept) * tracking.stride_px,
        pixels, static_cast<std::size_t>(tracking.width_px));
    ++tracking.rows_taken;
}

void make_room(int rows, Tracking& tracking) {
    const int kept = tracking.rows_taken - tracking.first_kept;
    if (kept + rows <= tracking.rows_kept) return;
    // At most half of the stored rows are needed, so source and destination do not overlap.
    tracking.first_kept = tracking.rows_taken - kRowsNeeded;
    std::memcpy(tracking.rows.data(),
                tracking.rows.data() + (kept - kRowsNeeded) * tracking.stride_px,
                static_cast<std::size_t>(kRowsNeeded * tracking.stride_px));
}

}  // namespace dotpose::core
