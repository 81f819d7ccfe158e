// Draws dots of any shape by sampling the ink. This is slow, but independent of the dot model of
// the core.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "../geometry.hpp"

namespace dotpose::core_test {

/// Returns true if there is ink at a position, given in px from the middle of a dot.
using InkAt = std::function<bool(Vec2)>;

inline InkAt disc(double radius_px) {
    return [=](Vec2 p) { return p.x * p.x + p.y * p.y <= radius_px * radius_px; };
}
inline InkAt ellipse(double half_u_px, double half_v_px) {
    return [=](Vec2 p) { return std::hypot(p.x / half_u_px, p.y / half_v_px) <= 1; };
}
inline InkAt square(double side_px) {
    return [=](Vec2 p) { return std::max(std::abs(p.x), std::abs(p.y)) <= side_px / 2; };
}

/// The darkness of the pixels around a dot, row by row.
struct DrawnDot {
    static constexpr int kHalf_px = 6;
    static constexpr int kSide = 2 * kHalf_px + 1;

    double at(int u, int v) const {
        return darkness[static_cast<std::size_t>((v + kHalf_px) * kSide + u + kHalf_px)];
    }
    std::vector<double> darkness;
};

/// Returns the fraction of the light from a point that reaches one pixel after a Gaussian blur,
/// along one axis. The point is `offset_px` from the middle of the pixel along this axis.
inline double collected(double offset_px, double blur_px) {
    const double scale = blur_px * std::numbers::sqrt2;
    return 0.5 * (std::erf((offset_px + 0.5) / scale) - std::erf((offset_px - 0.5) / scale));
}

/// Draws a dot centred at `centre`, in px from the middle of the central pixel.
inline DrawnDot drawn_dot(const InkAt& ink, Vec2 centre, double blur_px) {
    constexpr int kPerPixel = 40;
    constexpr double kReach_px = 5;
    constexpr int kSamples = static_cast<int>(2 * kReach_px * kPerPixel);
    constexpr auto kSide = static_cast<std::size_t>(DrawnDot::kSide);
    std::vector<std::array<double, kSide>> weights_u(kSamples);
    std::vector<std::array<double, kSide>> weights_v(kSamples);
    const auto place = [](int sample) { return (sample + 0.5) / kPerPixel - kReach_px; };
    for (int s = 0; s < kSamples; ++s) {
        for (int i = 0; i < DrawnDot::kSide; ++i) {
            const double from_pixel = place(s) - (i - DrawnDot::kHalf_px);
            const auto to = static_cast<std::size_t>(s);
            const auto pixel = static_cast<std::size_t>(i);
            weights_u[to][pixel] = collected(from_pixel + centre.x, blur_px) / kPerPixel;
            weights_v[to][pixel] = collected(from_pixel + centre.y, blur_px) / kPerPixel;
        }
    }
    DrawnDot dot{std::vector<double>(kSide * kSide)};
    for (int y = 0; y < kSamples; ++y) {
        std::array<double, kSide> row{};
        bool has_ink = false;
        for (int x = 0; x < kSamples; ++x) {
            if (!ink({place(x), place(y)})) continue;
            has_ink = true;
            for (std::size_t u = 0; u < kSide; ++u)
                row[u] += weights_u[static_cast<std::size_t>(x)][u];
        }
        if (!has_ink) continue;
        for (std::size_t v = 0; v < kSide; ++v) {
            for (std::size_t u = 0; u < kSide; ++u)
                dot.darkness[v * kSide + u] += row[u] * weights_v[static_cast<std::size_t>(y)][v];
        }
    }
    return dot;
}

/// Draws a dot that moves by `motion_px` during the exposure. It is at `centre` in the middle of
/// the exposure.
inline DrawnDot moving_dot(const InkAt& ink, Vec2 centre, double blur_px, Vec2 motion_px) {
    constexpr int kMoments = 9;
    DrawnDot mean{std::vector<double>(static_cast<std::size_t>(DrawnDot::kSide * DrawnDot::kSide))};
    for (int i = 0; i < kMoments; ++i) {
        const double time = (i + 0.5) / kMoments - 0.5;
        const DrawnDot dot = drawn_dot(ink, centre + time * motion_px, blur_px);
        for (std::size_t pixel = 0; pixel < mean.darkness.size(); ++pixel)
            mean.darkness[pixel] += dot.darkness[pixel] / kMoments;
    }
    return mean;
}

}  // namespace dotpose::core_test
