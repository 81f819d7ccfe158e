#include "core/detect/level_at.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/detect/surroundings.hpp"

namespace dotpose::core {
namespace {

/// Number of pixels per axis that contribute to the level at a point.
constexpr int kTaps = 4;

/// Returns the weights of a 1-2-1 binomial filter with a sub-pixel shift, in units of 1/1024. A
/// wider filter would include more of a blurred dot, but also more of its surroundings.
std::array<int, kTaps> taps(std::int32_t position_q8) {
    constexpr std::array<int, kTaps + 1> kBinomial{0, 1, 2, 1, 0};
    const int fraction = position_q8 & 255;
    std::array<int, kTaps> weights;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        weights[i] = kBinomial[i + 1] * (256 - fraction) + kBinomial[i] * fraction;
    }
    return weights;
}

/// Returns the level of a pixel, corrected if the pixel is defective. For a pixel on or beyond the
/// border, returns the level of the nearest inner pixel, because the correction needs eight
/// neighbours.
int level_near(const ImageView& image, int u, int v) {
    return without_defect(image, std::clamp(u, 1, image.width_px - 2),
                          std::clamp(v, 1, image.height_px - 2));
}

}  // namespace

bool shows_level(const ImageView& image, FixedVec point_q8) {
    const int u = point_q8.x >> 8;
    const int v = point_q8.y >> 8;
    return u >= 0 && v >= 0 && u + 1 < image.width_px && v + 1 < image.height_px;
}

int level_at_q8(const ImageView& image, FixedVec point_q8) {
    const int u0 = (point_q8.x >> 8) - 1;
    const int v0 = (point_q8.y >> 8) - 1;
    const auto across = taps(point_q8.x);
    const auto down = taps(point_q8.y);
    int sum_q18 = 0;
    for (int v = 0; v < kTaps; ++v) {
        int row_sum_q10 = 0;
        for (int u = 0; u < kTaps; ++u) {
            row_sum_q10 += across[static_cast<std::size_t>(u)] * level_near(image, u0 + u, v0 + v);
        }
        sum_q18 += down[static_cast<std::size_t>(v)] * (row_sum_q10 >> 2);
    }
    return sum_q18 >> 10;
}

}  // namespace dotpose::core
