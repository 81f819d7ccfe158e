#include "core/detect/newest_rows.hpp"

#include <cstring>

namespace dotpose::core {

void keep_row(const std::uint8_t* pixels, Tracking& tracking) {
    std::uint8_t* const rows = tracking.rows.data();
    const int stride = tracking.stride_px;
    if (tracking.rows_taken - tracking.first_kept == tracking.rows_kept) {
        // At most half of the memory: they do not overlap.
        tracking.first_kept = tracking.rows_taken - tracking.rows_needed;
        std::memcpy(rows, rows + (tracking.rows_kept - tracking.rows_needed) * stride,
                    static_cast<std::size_t>(tracking.rows_needed * stride));
    }
    std::memcpy(rows + (tracking.rows_taken - tracking.first_kept) * stride, pixels,
                static_cast<std::size_t>(tracking.width_px));
    ++tracking.rows_taken;
}

}  // namespace dotpose::core
