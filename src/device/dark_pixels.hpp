// Dark pixels: finds the pixels in the stored rows that are darker than the paper.
#pragma once

#include <algorithm>

#include "core/noinline.hpp"
#include "device/newest_rows.hpp"

namespace dotpose::core {

/// Width and height of a part of the image, in px. The paper level is estimated separately for each
/// part.
inline constexpr int kPartWidth_px = 16;
inline constexpr int kPartHeight_px = 8;

/// Returns the level below which a pixel is dark. This level is close to the paper level, because
/// dots may be pale.
constexpr int paper_edge(int paper) {
    return paper - (paper >> 4);
}

/// Returns the mean of every fourth pixel in every second row of a part. At most an eighth of the
/// pixels are dark, so the mean is only slightly below the paper level.
int sampled_mean(const std::uint8_t* row, int stride);

/// Returns the first pixel in [at, end) that is darker than `level`, or `end` if there is none.
const std::uint8_t* next_dark(const std::uint8_t* at, const std::uint8_t* end, int level);

/// A rectangle of pixels. `end_u` and `end_v` are exclusive.
struct PixelArea {
    int u;
    int v;
    int end_u;
    int end_v;
};

/// Calls `use(pixel, u, v)` for each dark pixel of a part.
template <typename Use>
DOTPOSE_NOINLINE void visit_part(const Tracking& tracking, const PixelArea& part, Use& use) {
    const int stride = tracking.stride_px;
    const int sampled_u =
        std::min(part.u, tracking.width_px - tracking.left_out_px - kPartWidth_px);
    const int sampled_v = std::min(part.v, tracking.rows_taken - kPartHeight_px);
    const int level = paper_edge(sampled_mean(kept_row(tracking, sampled_v) + sampled_u, stride));
    const std::uint8_t* row = kept_row(tracking, part.v) + part.u;
    for (int v = part.v; v < part.end_v; ++v, row += stride) {
        const std::uint8_t* const end = row + (part.end_u - part.u);
        for (const std::uint8_t* at = row; (at = next_dark(at, end, level)) != end; ++at)
            use(at, part.u + static_cast<int>(at - row), v);
    }
}

/// Calls `use(pixel, u, v)` for each dark pixel of an area. All rows of the parts that begin in the
/// area must be stored.
template <typename Use>
void visit_dark_pixels(const Tracking& tracking, const PixelArea& area, Use use) {
    for (int v = area.v; v < area.end_v; v += kPartHeight_px) {
        for (int u = area.u; u < area.end_u; u += kPartWidth_px) {
            visit_part(tracking,
                       {u, v, std::min(u + kPartWidth_px, area.end_u),
                        std::min(v + kPartHeight_px, area.end_v)},
                       use);
        }
    }
}

}  // namespace dotpose::core
