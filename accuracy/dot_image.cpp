#include "dot_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace dotpose::tables {

DotImage::DotImage(double radius_px, double blur_px, Vec2 motion_px) : blur_px_(blur_px) {
    constexpr int kAcross = 16;
    constexpr int kMoments = 7;
    const int moments = motion_px.x == 0 && motion_px.y == 0 ? 1 : kMoments;
    const double step_px = 2 * radius_px / kAcross;
    for (int i = 0; i < kAcross * kAcross; ++i) {
        const double u = (i % kAcross + 0.5) * step_px - radius_px;
        const double v = (i / kAcross + 0.5) * step_px - radius_px;
        if (std::hypot(u, v) > radius_px) continue;
        for (int n = 0; n < moments; ++n) {
            const double time = (n + 0.5) / moments - 0.5;
            points_.push_back({u + time * motion_px.x, v + time * motion_px.y});
        }
    }
    weight_ = std::numbers::pi * radius_px * radius_px / static_cast<double>(points_.size());
}

double DotImage::fraction(double distance_px) const {
    const double by = 1 / (blur_px_ * std::numbers::sqrt2);
    return (std::erf((distance_px + 0.5) * by) - std::erf((distance_px - 0.5) * by)) / 2;
}

double DotImage::derivative_of_fraction(double distance_px) const {
    const auto density = [&](double x) {
        return std::exp(-x * x / (2 * blur_px_ * blur_px_)) /
               (blur_px_ * std::sqrt(2 * std::numbers::pi));
    };
    return density(distance_px + 0.5) - density(distance_px - 0.5);
}

double DotImage::darkness(Vec2 from_dot) const {
    double sum = 0;
    for (const Vec2& point : points_)
        sum += fraction(from_dot.x - point.x) * fraction(from_dot.y - point.y);
    return weight_ * sum;
}

Vec2 DotImage::derivative(Vec2 from_dot) const {
    Vec2 sum;
    for (const Vec2& point : points_) {
        const double u = from_dot.x - point.x;
        const double v = from_dot.y - point.y;
        sum.x -= weight_ * derivative_of_fraction(u) * fraction(v);
        sum.y -= weight_ * fraction(u) * derivative_of_fraction(v);
    }
    return sum;
}

DotTable::DotTable(const DotImage& dot) {
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            values_.push_back(dot.darkness({1.0 * i / kSteps - kReach_px - 1,  //
                                            1.0 * j / kSteps - kReach_px - 1}));
        }
    }
}

double DotTable::darkness(Vec2 from_dot) const {
    if (std::max(std::abs(from_dot.x), std::abs(from_dot.y)) > kReach_px) return 0;
    // Catmull-Rom interpolation along both axes.
    const auto weights = [](double t) {
        return std::array{0.5 * t * (-1 + t * (2 - t)), 0.5 * (2 + t * t * (3 * t - 5)),
                          0.5 * t * (1 + t * (4 - 3 * t)), 0.5 * t * t * (t - 1)};
    };
    const double x = (from_dot.x + kReach_px + 1) * kSteps;
    const double y = (from_dot.y + kReach_px + 1) * kSteps;
    const int i = static_cast<int>(x);
    const int j = static_cast<int>(y);
    const auto across = weights(x - i);
    const auto down = weights(y - j);
    double sum = 0;
    for (int n = 0; n < 4; ++n) {
        double row = 0;
        for (int m = 0; m < 4; ++m)
            row += across[static_cast<std::size_t>(m)] * at(i - 1 + m, j - 1 + n);
        sum += down[static_cast<std::size_t>(n)] * row;
    }
    return sum;
}

GreyImage draw_with(const DotTable& dot, const Shot& shot) {
    const int width = shot.camera.width_px;
    const int height = shot.camera.height_px;
    const Vec2 centre_px{(width - 1) / 2.0, (height - 1) / 2.0};
    const Pattern& pattern = shot.page.pattern;
    const double spacing_px = pattern.spacing_mm / shot.camera.mm_per_px;
    const double displacement = pattern.displacement_mm / pattern.spacing_mm;
    const double c = std::cos(shot.pose.theta_rad);
    const double s = std::sin(shot.pose.theta_rad);

    const Imperfections& of = shot.imperfections;
    const Vec2 fall{of.fall * std::cos(of.fall_direction_rad),
                    of.fall * std::sin(of.fall_direction_rad)};
    const auto light_at = [&](Vec2 at) {
        return 1 - fall.x * (at.x - centre_px.x) / width - fall.y * (at.y - centre_px.y) / height;
    };

    std::vector<double> darkness(static_cast<std::size_t>(width * height));
    const int reach = static_cast<int>(std::hypot(width, height) / 2 / spacing_px) + 2;
    for (int row = -reach; row <= reach; ++row) {
        for (int column = -reach; column <= reach; ++column) {
            const Cell cell{shot.pose.cell.x + static_cast<std::uint32_t>(column),
                            shot.pose.cell.y + static_cast<std::uint32_t>(row)};
            const Symbol symbol = symbol_at(pattern.code, cell, pattern.section);
            const double x =
                (column - shot.pose.fraction_x + displacement * dx(symbol)) * spacing_px;
            const double y = (row - shot.pose.fraction_y + displacement * dy(symbol)) * spacing_px;
            const Vec2 at{centre_px.x + c * x + s * y, centre_px.y - s * x + c * y};
            const auto first = [](double centre) {
                return std::max(0, static_cast<int>(std::ceil(centre - DotTable::kReach_px)));
            };
            for (int v = first(at.y); v < std::min(height * 1.0, at.y + DotTable::kReach_px); ++v) {
                for (int u = first(at.x); u < std::min(width * 1.0, at.x + DotTable::kReach_px);
                     ++u) {
                    // The illumination is sampled at the dot rather than at the pixel, because
                    // light is reflected by the paper before the optics blur the image.
                    darkness[static_cast<std::size_t>(width * v + u)] +=
                        light_at(at) * dot.darkness({u - at.x, v - at.y});
                }
            }
        }
    }

    Rng rng(shot.seed, 2);
    GreyImage image{{}, width, height};
    for (int v = 0; v < height; ++v) {
        for (int u = 0; u < width; ++u) {
            const double ink = darkness[static_cast<std::size_t>(width * v + u)];
            const double level =
                of.paper_level * (light_at({1.0 * u, 1.0 * v}) - (1 - of.ink_reflectance) * ink) +
                of.noise_sigma * rng.normal();
            image.pixels.push_back(
                static_cast<std::uint8_t>(std::clamp(std::floor(level + 0.5), 0.0, 255.0)));
        }
    }
    return image;
}

}  // namespace dotpose::tables
