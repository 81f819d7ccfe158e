#include "device/fine_dots.hpp"

#include <algorithm>

#include "core/detect/inverses.hpp"
#include "core/noinline.hpp"
#include "device/dark_pixels.hpp"
#include "device/newest_rows.hpp"

namespace dotpose::core {
namespace {

/// Half-width of the square in which a dot is measured, in px.
constexpr int kHalf_px = 2;
/// Minimum mass of a dot. `Inverse` is not accurate enough for smaller masses.
constexpr int kMinMass = 16;

/// Returns true if the pixel is darker than all adjacent pixels. Ties are broken in favour of the
/// last pixel in row-major order.
DOTPOSE_NOINLINE bool is_darkest(const std::uint8_t* at, int stride) {
    const int here = *at;
    const std::uint8_t* const above = at - stride;
    const std::uint8_t* const below = at + stride;
    // The search reaches most dots at their upper edges, where a pixel below is darker. The lower
    // pixels are therefore compared first.
    return here < below[0] && here < at[1] && here < below[1] && here < below[-1] &&
           here <= at[-1] && here <= above[0] && here <= above[1] && here <= above[-1];
}

[[gnu::always_inline]] inline void append_dot(FixedVec pixel, const DarkSums& sums,
                                              Tracking& tracking) {
    if (sums.mass < kMinMass) return;
    if (tracking.dots_measured == static_cast<int>(tracking.found.size())) return;
    const Inverse inverse(sums.mass);
    const auto from_middle_q8 = [](int at, int side_px) { return at * 256 - (side_px - 1) * 128; };
    DetectedDot& dot = tracking.found[static_cast<std::size_t>(tracking.dots_measured++)];
    dot.centre_q8 = {from_middle_q8(pixel.x, tracking.width_px) + inverse.quotient_q8(sums.x),
                     from_middle_q8(pixel.y, tracking.height_px) + inverse.quotient_q8(sums.y)};
    dot.mass = static_cast<std::uint16_t>(sums.mass);
}

/// Measures the dot around its darkest pixel.
DOTPOSE_NOINLINE void measure_dot(const std::uint8_t* at, int u, int v, Tracking& tracking) {
    const int stride = tracking.stride_px;
    const std::uint8_t* const first = at - kHalf_px * (stride + 1);
    const std::uint8_t* const last = first + 2 * kHalf_px * stride;
    // A neighbouring dot can cover at most one of the two corners on each diagonal, so the brighter
    // corner is at the paper level.
    const int paper = (std::max<int>(first[0], last[2 * kHalf_px]) +
                       std::max<int>(first[2 * kHalf_px], last[0])) >>
                      1;
    const int level = paper_edge(paper);
    if (*at >= level || paper - *at < tracking.min_contrast) return;
    append_dot({u, v}, dark_sums<kHalf_px>(first, stride, level), tracking);
}

}  // namespace

void add_fine_dot(FixedVec pixel, const DarkSums& sums, Tracking& tracking) {
    append_dot(pixel, sums, tracking);
}

void drop_unlike_dots(Tracking& tracking) {
    const auto all = tracking.found.first(static_cast<std::size_t>(tracking.dots_measured));
    std::int32_t mass = 0;
    for (const DetectedDot& dot : all)
        mass += dot.mass;
    const std::int32_t mean = mass / std::max(tracking.dots_measured, 1);
    const std::int32_t min_mass = mean * 3 / 8;
    const std::int32_t max_mass = mean * 5 / 2;
    DetectedDot* kept = all.data();
    for (const DetectedDot& dot : all) {
        if (dot.mass < min_mass || dot.mass > max_mass) continue;
        // Copies only the centre, because no later stage uses the mass. On small processors,
        // copying the whole struct would call `memcpy`.
        kept->centre_q8.x = dot.centre_q8.x;
        kept->centre_q8.y = dot.centre_q8.y;
        ++kept;
    }
    tracking.dots_measured = static_cast<int>(kept - all.data());
}

void find_fine_dots(Tracking& tracking) {
    const int first = tracking.left_out_px + kHalf_px;
    const int end = tracking.width_px - tracking.left_out_px - kHalf_px;
    const int end_v = tracking.rows_taken - kHalf_px;
    visit_dark_pixels(tracking, {first, tracking.next_reading, end, end_v},
                      [&](const std::uint8_t* at, int u, int v) {
                          if (is_darkest(at, tracking.stride_px)) measure_dot(at, u, v, tracking);
                      });
    tracking.next_reading = std::max(tracking.next_reading, end_v);
}

}  // namespace dotpose::core
