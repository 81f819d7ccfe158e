#include "device/near_dot.hpp"

#include "core/math/fixed.hpp"

namespace dotpose::core {

void set_half_side(int half_px, Tracking& tracking) {
    tracking.half_side_px = static_cast<std::uint8_t>(half_px);
    tracking.corner_offset = -half_px * (tracking.stride_px + 1);
    tracking.corners_apart = 2 * half_px * tracking.stride_px;
}

bool lay_dot_pixels(Tracking& tracking) {
    int half_px = kSmallHalf_px;
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
        // Centre of a quadrant of a pixel, relative to the upper left corner of the pixel. All
        // intersections in the same quadrant of a pixel use the same pixel offsets.
        const FixedVec in_pixel_q16{quarter % 2 == 0 ? 16384 : 49152, quarter < 2 ? 16384 : 49152};
        for (std::size_t s = 0; s < 4; ++s) {
            const FixedVec displaced_q16 = tracking.displaced_q16[s];
            // The four pixels that are read for a dot must be inside the square around the
            // intersection. The limits allow for rounding, which changes the offset of the first
            // pixel by at most 3/4 of a pixel.
            if (!is_within(displaced_q16, half_px * 65536 - 49153)) half_px = kHalf_px;
            if (!is_within(displaced_q16, kHalf_px * 65536 - 49153)) return false;
            const FixedVec place_q16 = in_pixel_q16 + displaced_q16;
            tracking.dot_pixels[quarter][s] = static_cast<std::int16_t>(
                (place_q16.y >> 16) * tracking.stride_px + (place_q16.x >> 16));
        }
    }
    set_half_side(half_px, tracking);
    return true;
}

bool measure_around(const Tracking& tracking, FixedVec intersection_q16, NearDot& dot) {
    const FixedVec pixel = pixel_at(intersection_q16);
    if (!is_kept(tracking, pixel, kHalf_px)) return false;
    const std::int32_t paper = paper_around(tracking, kept_row(tracking, pixel.y) + pixel.x);
    const std::int32_t level = paper - ((paper * tracking.cut_q8) >> 8);
    if (paper == 0) return false;
    return measure_square<kHalf_px>(tracking, intersection_q16, level, dot);
}

}  // namespace dotpose::core
