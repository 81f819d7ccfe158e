#include "core/pose/measure.hpp"

#include <array>
#include <optional>

#include "core/pixels/surroundings.hpp"
#include "core/pixels/undistort.hpp"
#include "core/plane.hpp"

namespace dotpose::core {
namespace {

constexpr int kMostIterations = 5;
constexpr int kSettled_q8 = 4;
constexpr int kMostHalf_px = 24;

/// The window that dots are seen through.
struct Window {
    int half_px = 0;
    std::int32_t sigma_q8 = 0;

    /// For dots that blur has made about a tenth of the spacing wide (one sigma).
    explicit Window(std::int32_t spacing_q8)
        : half_px(std::min(std::max(spacing_q8 * 9 / 32 + 255, 768) / 256, kMostHalf_px)),
          sigma_q8(std::max(spacing_q8 * 11 / 128, 230)) {}

    /// As wide as fits into the image around a pixel, neighbours included; 0 where that is too
    /// little. Dots at the border tell most of the angle.
    int half_within(const ImageView& image, int u, int v) const {
        const int room = std::min({u, v, image.width_px - 1 - u, image.height_px - 1 - v}) - 1;
        return 2 * room < half_px ? 0 : std::min(room, half_px);
    }

    /// exp(-r^2 / (2 sigma^2)), times 2^16.
    std::int64_t weight_q16(std::int64_t squared_q16) const {
        // In powers of two: r^2 / (2 sigma^2 ln 2).
        const auto log2_q8 =
            static_cast<int>(squared_q16 * 185 / (std::int64_t{sigma_q8} * sigma_q8));
        return log2_q8 >= 30 * 256 ? 0 : (std::int64_t{1} << 32) / exp2_q16(log2_q8);
    }
};

/// A pixel, brought back into the range of its neighbours where it is far outside: a defect of the
/// sensor. It has them: windows keep off the border.
int without_defect(const ImageView& image, int u, int v) {
    const auto [low, high] = range_around(image, u, v);
    const int level = image.row(v)[u];
    const int far = high / 4;
    return level < low - far || level > high + far ? std::clamp(level, low, high) : level;
}

/// The light on the paper around a dot: a plane through the window's rim, in 1/256 grey level.
struct RimLight {
    int middle_q8 = 0;
    int slope_x_q8 = 0;  ///< per px
    int slope_y_q8 = 0;

    int at(int du, int dv) const { return middle_q8 + slope_x_q8 * du + slope_y_q8 * dv; }
};

RimLight light_on_rim(const ImageView& image, int u0, int v0, int half) {
    int left = 0;
    int right = 0;
    int top = 0;
    int bottom = 0;
    for (int i = -half; i <= half; ++i) {
        left += without_defect(image, u0 - half, v0 + i);
        right += without_defect(image, u0 + half, v0 + i);
        top += without_defect(image, u0 + i, v0 - half);
        bottom += without_defect(image, u0 + i, v0 + half);
    }
    const int side = 2 * half + 1;
    return {(left + right + top + bottom) * 64 / side, (right - left) * 256 / (2 * half * side),
            (bottom - top) * 256 / (2 * half * side)};
}

/// The dot near a point; nothing where the window leaves the image, or holds no dark spot.
std::optional<Dot> measure(const ImageView& image, const Window& window, Vec start_q8) {
    // The fit tells dirt from dots that were printed badly; a closer limit would cut off the tail
    // of these, which costs accuracy and hides how much it was.
    const std::int64_t farthest = 9 * std::int64_t{window.sigma_q8} * window.sigma_q8;
    Vec centre_q8 = start_q8;
    std::int64_t mass_q24 = 0;
    int light_q8 = 0;
    for (int iteration = 0; iteration < kMostIterations; ++iteration) {
        const int u0 = (centre_q8.x + 128) >> 8;
        const int v0 = (centre_q8.y + 128) >> 8;
        const int half = window.half_within(image, u0, v0);
        if (half == 0) return {};
        const RimLight light = light_on_rim(image, u0, v0, half);
        light_q8 = light.middle_q8;
        std::int64_t sum_x = 0;
        std::int64_t sum_y = 0;
        mass_q24 = 0;
        for (int v = v0 - half; v <= v0 + half; ++v) {
            for (int u = u0 - half; u <= u0 + half; ++u) {
                const Vec d{u * 256 - centre_q8.x, v * 256 - centre_q8.y};
                const std::int64_t weight =
                    window.weight_q16(squared(d)) *
                    (light.at(u - u0, v - v0) - without_defect(image, u, v) * 256);
                mass_q24 += weight;
                sum_x += weight * d.x;
                sum_y += weight * d.y;
            }
        }
        if (mass_q24 <= 0) return {};
        // A window as wide as the dot shows half of its distance from the middle.
        const Vec step{static_cast<std::int32_t>(2 * sum_x / mass_q24),
                       static_cast<std::int32_t>(2 * sum_y / mass_q24)};
        centre_q8 = centre_q8 + step;
        const Vec moved = centre_q8 - start_q8;
        if (squared(moved) > farthest) return {};
        if (squared(step) < kSettled_q8 * kSettled_q8) break;
    }
    // As a share of the light, which makes dots alike all over the image.
    const std::int64_t mass = mass_q24 / std::max(light_q8, 256);
    return Dot{centre_q8, static_cast<std::uint16_t>(std::min<std::int64_t>(mass >> 8, 65535)), 0};
}

/// Drops what is much lighter or much darker than the typical dot: paper where a dot is missing,
/// dirt, graphics.
void drop_strange(Grid& grid, std::span<Dot> dots) {
    constexpr std::size_t kSample = 256;
    std::array<std::int32_t, kSample> masses;
    std::size_t n = 0;
    const std::size_t step = dots.size() / kSample + 1;
    for (std::size_t i = 0; i < dots.size(); i += step)
        masses[n++] = dots[i].mass;
    const int typical = median(std::span(masses).first(n));
    for (GridCell& cell : grid.storage.first(static_cast<std::size_t>(grid.columns * grid.rows))) {
        if (!cell.has_dot()) continue;
        const int mass = dots[cell.dot].mass;
        if (3 * mass < 2 * typical || 2 * mass > 3 * typical) cell.dot = GridCell::kNoDot;
    }
}

}  // namespace

int measure_dots(const ImageView& image, const Lens& lens, const PlaneFromImage& pattern_from_image,
                 const Nominal& nominal, Grid& grid, std::span<Dot> dots) {
    const auto length_q24 =
        square_root(static_cast<std::uint64_t>(squared(pattern_from_image.du_q24)));
    const Window window(
        static_cast<std::int32_t>((std::int64_t{1} << 32) / std::max(length_q24, 1U)));
    std::size_t count = 0;
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            GridCell& cell = grid.at(i, j);
            if (cell.dot == GridCell::kHidden) continue;
            cell.dot = GridCell::kNoDot;
            if (count == dots.size()) continue;
            const Vec step = nominal.pattern_step({i, j});
            const Symbol symbol = nominal.symbol(step);
            const Vec place{step.x * 65536 + dx(symbol) * kDisplacement_q16,
                            step.y * 65536 + dy(symbol) * kDisplacement_q16};
            const auto dot =
                measure(image, window, distorted_point_q8(lens, pattern_from_image, place));
            if (!dot) continue;
            cell.dot = static_cast<std::uint16_t>(count);
            dots[count++] = *dot;
        }
    }
    drop_strange(grid, dots.first(count));
    return static_cast<int>(count);
}

}  // namespace dotpose::core
