/// Frames of two adjacent sheets, which are separated by a straight seam. The renderer of these
/// frames shares no code with the simulator, so it cannot repeat the simulator's errors. Dots are
/// discs that are cut off at the seam. The renderer samples 6 x 6 points per pixel, and then adds
/// blur, light and noise.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/random.hpp"
#include "dotpose/tools/truth.hpp"

namespace dotpose::test {

/// Two half planes of one pattern, seen by a camera that looks straight at the paper. The image
/// centre is on the near side.
struct SeamShot {
    int width_px = 188;
    int height_px = 120;
    double spacing_px = 11;
    Cell cell;  ///< integer part of the pattern position at the image centre
    Section section;
    double fraction_x = 0;
    double fraction_y = 0;
    double theta_rad = 0;

    double seam_px = 0;        ///< distance from the image centre to the seam
    double direction_rad = 0;  ///< direction from the image centre to the seam, in the image
    double along_px = 0;       ///< position of the far side's rotation centre along the seam
    double turn_rad = 0;       ///< rotation of the far side
    double shift_x_px = 0;     ///< shift of the far side
    double shift_y_px = 0;

    double paper_level = 190;
    double fall = 0.1;  ///< brightness at the right side is lower by this fraction
    double blur_px = 0.6;
    double noise = 3;
    double jitter_grid = 0.02;  ///< standard deviation of the printed dot positions, per axis
    std::uint64_t seed = 1;

    Truth truth() const {
        Truth truth;
        truth.x_grid = cell.x + fraction_x;
        truth.y_grid = cell.y + fraction_y;
        truth.theta_rad = theta_rad;
        truth.section = section;
        return truth;
    }
};

/// Ink coverage of each pixel of an image, and of the border around the image that the blur needs.
class InkMap {
  public:
    InkMap(int width_px, int height_px)
        : columns_(static_cast<std::size_t>(width_px) + 2 * kBorder),
          rows_(static_cast<std::size_t>(height_px) + 2 * kBorder),
          ink_(columns_ * rows_) {}

    /// Adds ink at the points for which `is_ink` returns true. Tests only pixels within `radius` of
    /// (x, y) along each axis. All lengths are in px.
    template <typename IsInk>
    void add(double x, double y, double radius, IsInk is_ink) {
        constexpr int kSamples = 6;
        const auto first = [&](double at) {
            return std::max(static_cast<int>(std::floor(at - radius)), -static_cast<int>(kBorder));
        };
        const auto last = [&](double at, std::size_t size) {
            return std::min(static_cast<int>(std::ceil(at + radius)),
                            static_cast<int>(size) - static_cast<int>(kBorder) - 1);
        };
        for (int v = first(y); v <= last(y, rows_); ++v) {
            for (int u = first(x); u <= last(x, columns_); ++u) {
                int count = 0;
                for (int k = 0; k < kSamples * kSamples; ++k) {
                    count += is_ink(u + (k % kSamples + 0.5) / kSamples - 0.5,
                                    v + (k / kSamples + 0.5) / kSamples - 0.5);
                }
                at(u, v) += static_cast<double>(count) / (kSamples * kSamples);
            }
        }
    }

    void blur(double sigma_px) {
        std::vector<double> weights;
        double sum = 0;
        for (int k = -kReach; k <= kReach; ++k) {
            weights.push_back(std::exp(-k * k / (2 * sigma_px * sigma_px)));
            sum += weights.back();
        }
        for (double& weight : weights)
            weight /= sum;
        blur_along(1, weights);
        blur_along(columns_, weights);
    }

    double& at(int u, int v) {
        return ink_[(static_cast<std::size_t>(v) + kBorder) * columns_ +
                    static_cast<std::size_t>(u) + kBorder];
    }

  private:
    static constexpr std::size_t kBorder = 12;
    static constexpr int kReach = 6;

    void blur_along(std::size_t stride, const std::vector<double>& weights) {
        const std::vector<double> before = ink_;
        const std::size_t margin = kReach * stride;
        for (std::size_t i = margin; i + margin < ink_.size(); ++i) {
            double sum = 0;
            for (std::size_t k = 0; k < weights.size(); ++k)
                sum += weights[k] * before[i - margin + k * stride];
            ink_[i] = sum;
        }
    }

    std::size_t columns_;
    std::size_t rows_;
    std::vector<double> ink_;
};

/// Adds the dots of one side of the seam. `side` is +1 for the near side and -1 for the far side.
inline void add_side(const SeamShot& shot, int side, InkMap& map, Rng& rng) {
    const double nx = std::cos(shot.direction_rad);
    const double ny = std::sin(shot.direction_rad);
    const double hinge_x = shot.seam_px * nx - shot.along_px * ny;
    const double hinge_y = shot.seam_px * ny + shot.along_px * nx;
    const double turn = side > 0 ? 0 : shot.turn_rad;
    const double shift_x = side > 0 ? 0 : shot.shift_x_px;
    const double shift_y = side > 0 ? 0 : shot.shift_y_px;
    const double middle_x = (shot.width_px - 1) / 2.0;
    const double middle_y = (shot.height_px - 1) / 2.0;
    const double radius = shot.spacing_px / 6;
    const int reach =
        static_cast<int>(std::hypot(shot.width_px, shot.height_px) / 2 / shot.spacing_px) + 3;
    const double c = std::cos(shot.theta_rad);
    const double s = std::sin(shot.theta_rad);
    for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
            const Cell cell{shot.cell.x + static_cast<std::uint32_t>(i),
                            shot.cell.y + static_cast<std::uint32_t>(j)};
            const Symbol symbol = symbol_at(CodeVariant::anoto, cell, shot.section);
            const double x =
                i - shot.fraction_x + dx(symbol) / 6.0 + shot.jitter_grid * rng.normal();
            const double y =
                j - shot.fraction_y + dy(symbol) / 6.0 + shot.jitter_grid * rng.normal();
            // The image x axis is at angle theta in the pattern, so the pattern is rotated by
            // -theta.
            const double u = shot.spacing_px * (c * x + s * y) - hinge_x;
            const double v = shot.spacing_px * (c * y - s * x) - hinge_y;
            const double at_x =
                hinge_x + std::cos(turn) * u - std::sin(turn) * v + shift_x + middle_x;
            const double at_y =
                hinge_y + std::sin(turn) * u + std::cos(turn) * v + shift_y + middle_y;
            map.add(at_x, at_y, radius, [&](double px, double py) {
                const double beyond = (px - middle_x) * nx + (py - middle_y) * ny - shot.seam_px;
                return side * beyond <= 0 && std::hypot(px - at_x, py - at_y) <= radius;
            });
        }
    }
}

inline GreyImage render(const SeamShot& shot) {
    Rng rng(shot.seed);
    InkMap map(shot.width_px, shot.height_px);
    add_side(shot, 1, map, rng);
    add_side(shot, -1, map, rng);
    map.blur(shot.blur_px);
    GreyImage image;
    image.width_px = shot.width_px;
    image.height_px = shot.height_px;
    for (int v = 0; v < shot.height_px; ++v) {
        for (int u = 0; u < shot.width_px; ++u) {
            constexpr double kInk = 0.15;  // reflectance
            const double light = shot.paper_level * (1 - shot.fall * u / shot.width_px);
            const double level = light * (1 - (1 - kInk) * std::min(map.at(u, v), 1.0));
            image.pixels.push_back(static_cast<std::uint8_t>(
                std::lround(std::clamp(level + shot.noise * rng.normal(), 0.0, 255.0))));
        }
    }
    return image;
}

/// Returns a random view with a seam at most `max_distance_px` from the image centre. The far side
/// is shifted by up to half a spacing, and rotated by up to one degree about a random point on the
/// visible part of the seam.
inline SeamShot draw_seam_shot(int width_px, int height_px, double max_distance_px,
                               std::uint64_t seed, std::uint64_t index) {
    Rng rng(seed, index);
    SeamShot shot;
    shot.width_px = width_px;
    shot.height_px = height_px;
    shot.spacing_px = rng.uniform(10, 12);
    shot.cell = {rng.below(kPositionsPerAxis - 200) + 100,
                 rng.below(kPositionsPerAxis - 200) + 100};
    shot.section = {static_cast<std::uint8_t>(rng.below(kSections)),
                    static_cast<std::uint8_t>(rng.below(kSections))};
    shot.fraction_x = rng.uniform();
    shot.fraction_y = rng.uniform();
    const auto angle = [&] { return rng.uniform(-std::numbers::pi, std::numbers::pi); };
    shot.theta_rad = angle();
    shot.direction_rad = angle();
    const double nx = std::abs(std::cos(shot.direction_rad));
    const double ny = std::abs(std::sin(shot.direction_rad));
    shot.seam_px = rng.uniform(0, std::min((nx * width_px + ny * height_px) / 2, max_distance_px));
    shot.along_px = rng.uniform(-0.5, 0.5) * (ny * width_px + nx * height_px);
    shot.turn_rad = rng.uniform(-1, 1) * std::numbers::pi / 180;
    const double moved = rng.uniform(0, 0.5) * shot.spacing_px;
    const double moves_rad = angle();
    shot.shift_x_px = moved * std::cos(moves_rad);
    shot.shift_y_px = moved * std::sin(moves_rad);
    shot.paper_level = rng.uniform(150, 220);
    shot.fall = rng.uniform(0, 0.2);
    shot.blur_px = rng.uniform(0.4, 0.7);
    shot.noise = rng.uniform(2, 4);
    shot.seed = rng.bits();
    return shot;
}

}  // namespace dotpose::test
