#include "device/fine_dots.hpp"

#include <algorithm>

#include "core/detect/inverses.hpp"
#include "core/kernels/portable/dark_sums.hpp"
#include "core/noinline.hpp"
#include "device/newest_rows.hpp"

namespace dotpose::core {
namespace {

/// Half side of the square in which a dot is measured, in px. No other dot reaches its corners.
constexpr int kHalf_px = 2;
/// Size of the parts of the image in which the paper level is estimated, in px.
constexpr int kPartWidth_px = 16;
constexpr int kPartHeight_px = 8;
/// Minimum mass, for which `Inverse` is exact enough.
constexpr int kMinMass = 16;

/// Returns the level below which pixels are dark. It is close to the paper level, because dots are
/// pale.
constexpr int paper_edge(int paper) {
    return paper - (paper >> 4);
}

/// Returns true if no pixel around `at` is darker. Of several equally dark pixels, only the last
/// one counts.
DOTPOSE_NOINLINE bool is_darkest(const std::uint8_t* at, int stride) {
    const int here = *at;
    const std::uint8_t* const above = at - stride;
    const std::uint8_t* const below = at + stride;
    // The search meets most dots first at their upper edges, so the lower pixels are compared
    // first.
    return here < below[0] && here < at[1] && here < below[1] && here < below[-1] &&
           here <= at[-1] && here <= above[0] && here <= above[1] && here <= above[-1];
}

/// Measures the dot around its darkest pixel.
DOTPOSE_NOINLINE void add_dot(const std::uint8_t* at, int u, int v, Tracking& tracking) {
    const int stride = tracking.stride_px;
    const std::uint8_t* const first = at - kHalf_px * (stride + 1);
    const std::uint8_t* const last = first + 2 * kHalf_px * stride;
    const int paper = (first[0] + first[2 * kHalf_px] + last[0] + last[2 * kHalf_px]) >> 2;
    const int level = paper_edge(paper);
    if (*at >= level || paper - *at < tracking.min_contrast) return;
    const DarkSums sums = dark_sums<kHalf_px>(first, stride, level);
    if (sums.mass < kMinMass) return;
    if (tracking.dots_measured == static_cast<int>(tracking.fine_dots.size())) return;
    const Inverse inverse(sums.mass);
    const FixedVec offset_q8{inverse.quotient_q8(sums.x), inverse.quotient_q8(sums.y)};
    const auto from_middle = [](int pixel, int side_px, std::int32_t offset) {
        return static_cast<std::int16_t>(pixel * 256 + offset - (side_px - 1) * 128);
    };
    tracking.fine_dots[static_cast<std::size_t>(tracking.dots_measured++)] = {
        from_middle(u, tracking.width_px, offset_q8.x),
        from_middle(v, tracking.height_px, offset_q8.y), static_cast<std::int16_t>(sums.mass)};
}

/// Returns the mean of every fourth pixel in every second row of a part. At most an eighth of the
/// pixels are dark, so the mean is little below the paper level.
int sampled_mean(const std::uint8_t* row, int stride) {
    int sum = 0;
    for (int v = 0; v < kPartHeight_px; v += 2, row += 2 * stride)
        sum += row[0] + row[4] + row[8] + row[12];
    return sum >> 4;
}

/// Returns the next pixel below `level`, or `end`. Not inlined, because the caller would then need
/// more registers than small processors have.
DOTPOSE_NOINLINE const std::uint8_t* next_dark(const std::uint8_t* at, const std::uint8_t* end,
                                               int level) {
    for (; end - at >= 4; at += 4) {
        if (at[0] < level) return at;
        if (at[1] < level) return at + 1;
        if (at[2] < level) return at + 2;
        if (at[3] < level) return at + 3;
    }
    while (at != end && *at >= level)
        ++at;
    return at;
}

/// Adds the dots whose darkest pixels are in a part of the image, which begins at (u, v).
void search_part(int u, int v, int width_px, int height_px, Tracking& tracking) {
    const int stride = tracking.stride_px;
    const int sampled_u = std::min(u, tracking.width_px - tracking.left_out_px - kPartWidth_px);
    const int sampled_v = std::min(v, tracking.rows_taken - kPartHeight_px);
    const int level = paper_edge(sampled_mean(kept_row(tracking, sampled_v) + sampled_u, stride));
    const std::uint8_t* row = kept_row(tracking, v) + u;
    for (const int end_v = v + height_px; v < end_v; ++v, row += stride) {
        const std::uint8_t* const end = row + width_px;
        for (const std::uint8_t* at = row; (at = next_dark(at, end, level)) != end; ++at) {
            if (is_darkest(at, stride)) add_dot(at, u + static_cast<int>(at - row), v, tracking);
        }
    }
}

}  // namespace

void find_fine_dots(Tracking& tracking) {
    const int first = tracking.left_out_px + kHalf_px;
    const int end = tracking.width_px - tracking.left_out_px - kHalf_px;
    const int end_v = tracking.rows_taken - kHalf_px;
    for (int& v = tracking.next_reading; v < end_v;) {
        const int height_px = std::min(kPartHeight_px, end_v - v);
        for (int u = first; u < end; u += kPartWidth_px)
            search_part(u, v, std::min(kPartWidth_px, end - u), height_px, tracking);
        v += height_px;
    }
}

}  // namespace dotpose::core
