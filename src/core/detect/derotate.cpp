#include "core/detect/derotate.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace dotpose::core {
namespace {

/// Number of adjacent pixels whose source points are interpolated with the same quadratic. The
/// error of the interpolation is at most 0.003 px at a rotation of 60 degrees in 120 rows.
constexpr int kStep_px = 16;
/// Factor that converts px to the unit of source points, 2^-8 px.
constexpr float kUnit = 256;

/// Returns the grey level at the point (u, v), interpolated linearly. u and v are measured from the
/// first pixel, in units of 2^-8 px.
std::uint8_t level_at(const ImageView& image, int u_q8, int v_q8) {
    const std::uint8_t* upper = image.row(v_q8 >> 8) + (u_q8 >> 8);
    const std::uint8_t* lower = upper + image.stride_bytes;
    const int right = u_q8 & 255;
    const int down = v_q8 & 255;
    const int above = upper[0] * (256 - right) + upper[1] * right;
    const int below = lower[0] * (256 - right) + lower[1] * right;
    return static_cast<std::uint8_t>((above * (256 - down) + below * down + (1 << 15)) >> 16);
}

/// The quadratic through three values, at 0, kStep_px / 2 and kStep_px.
struct Quadratic {
    float at, slope, curve;

    Quadratic(float first, float middle, float last)
        : at(first),
          slope((4 * middle - 3 * first - last) / kStep_px),
          curve(2 * (first - 2 * middle + last) / (kStep_px * kStep_px)) {}
    int operator()(int i) const {
        const auto x = static_cast<float>(i);
        return static_cast<int>(at + x * (slope + x * curve));
    }
};

}  // namespace

ImageView derotated(const ImageView& image, const ReadoutTurn& turn,
                    std::span<std::uint8_t> memory) {
    const float centre_u = static_cast<float>(image.width_px - 1) / 2;
    const float centre_v = static_cast<float>(image.height_px - 1) / 2;
    std::uint8_t* out = memory.data();
    for (int v = 0; v < image.height_px; ++v) {
        const float y = static_cast<float>(v) - centre_v;
        // The source of the first point in each output row is computed with six Newton steps. For
        // each subsequent point, the iteration starts from a source row extrapolated from the
        // previous points, so one step suffices.
        FloatVec first = turn.seen_from({-centre_u, y}, y, 6);
        float down = 0;
        for (int u = 0; u < image.width_px; u += kStep_px) {
            const float x = static_cast<float>(u) - centre_u;
            const FloatVec middle = turn.seen_from({x + kStep_px / 2, y}, first.y + down, 1);
            const FloatVec last = turn.seen_from({x + kStep_px, y}, 2 * middle.y - first.y, 1);
            down = last.y - middle.y;
            const auto to_q8 = [](float px, float centre_px) {
                return (px + centre_px) * kUnit + 0.5F;
            };
            const Quadratic u_q8(to_q8(first.x, centre_u), to_q8(middle.x, centre_u),
                                 to_q8(last.x, centre_u));
            const Quadratic v_q8(to_q8(first.y, centre_v), to_q8(middle.y, centre_v),
                                 to_q8(last.y, centre_v));
            const int count = std::min(kStep_px, image.width_px - u);
            // The work is split into two loops, because compilers can vectorise only the first one.
            std::array<int, kStep_px> us;
            std::array<int, kStep_px> vs;
            for (int i = 0; i < kStep_px; ++i) {
                const auto k = static_cast<std::size_t>(i);
                us[k] = std::clamp(u_q8(i), 0, (image.width_px - 1) * 256 - 1);
                vs[k] = std::clamp(v_q8(i), 0, (image.height_px - 1) * 256 - 1);
            }
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
                *out++ = level_at(image, us[i], vs[i]);
            first = last;
        }
    }
    return {memory.data(), image.width_px, image.height_px, image.width_px};
}

}  // namespace dotpose::core
