#include "core/detect/ring.hpp"

#include <cstring>

namespace dotpose::core {

void keep_row(const std::uint8_t* pixels, Tracking& tracking) {
    if (tracking.rows_taken - tracking.first_of_lap == tracking.rows_kept)
        tracking.first_of_lap = tracking.rows_taken;
    std::uint8_t* const row =
        tracking.rows.data() + (tracking.rows_taken - tracking.first_of_lap) * tracking.stride_px;
    std::memcpy(row, pixels, static_cast<std::size_t>(tracking.width_px));
    ++tracking.rows_taken;
}

}  // namespace dotpose::core
