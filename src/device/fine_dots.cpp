#include "device/fine_dots.hpp"

#include "core/detect/inverses.hpp"
#include "core/kernels/portable/dark_sums.hpp"
#include "device/newest_rows.hpp"

namespace dotpose::core {
namespace {

/// Half side of the square in which a dot is measured, in px. No other dot reaches its corners.
constexpr int kHalf_px = 2;
/// Distance between a pixel and the pixel with which it is compared first, in px. No two dots of a
/// row of pixels are at this distance, so a dot is darker than this pixel.
constexpr int kBeside_px = 3;

/// Minimum mass, for which `Inverse` is exact enough.
constexpr int kMinMass = 16;

/// Returns the level below which pixels are dark. It is close to the paper level, because dots are
/// pale.
constexpr int paper_edge(int paper) {
    return paper - (paper >> 4);
}

/// Returns true if no pixel around `at` is darker. Of several equally dark pixels, only the last
/// one counts.
bool is_darkest(const std::uint8_t* at, int stride) {
    const int here = *at;
    const std::uint8_t* const above = at - stride;
    const std::uint8_t* const below = at + stride;
    return here <= at[-1] && here < at[1] && here <= above[0] && here < below[0] &&
           here <= above[-1] && here <= above[1] && here < below[-1] && here < below[1];
}

/// Measures the dot around its darkest pixel.
void add_dot(const std::uint8_t* at, int u, int v, Tracking& tracking) {
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

/// Adds the dots whose darkest pixels are in row `v`, from column `u` to the column before `end`.
/// Pixels are compared first with the pixel at the distance `beside`.
void search(int u, int end, int beside, int v, Tracking& tracking) {
    const std::uint8_t* const row = kept_row(tracking, v);
    const int stride = tracking.stride_px;
    const std::uint8_t* at = row + u;
    for (const std::uint8_t* const last = row + end; at != last; ++at) {
        if (at[0] < paper_edge(at[beside]) && is_darkest(at, stride))
            add_dot(at, static_cast<int>(at - row), v, tracking);
    }
}

}  // namespace

void find_fine_dots(Tracking& tracking) {
    const int first = tracking.left_out_px + kHalf_px;
    const int end = tracking.width_px - tracking.left_out_px - kHalf_px;
    const int middle = tracking.width_px / 2;
    int v = tracking.next_reading;
    for (; v + kHalf_px < tracking.rows_taken; ++v) {
        search(first, middle, kBeside_px, v, tracking);
        search(middle, end, -kBeside_px, v, tracking);
    }
    tracking.next_reading = v;
}

}  // namespace dotpose::core
