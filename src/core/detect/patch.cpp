#include "core/detect/patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/detect/tuning.hpp"
#include "core/math/tabled.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::patch;

/// Returns 2^24 / (n + 1), rounded up. Callers look up the results in a table, because a division
/// for each tile would be slower.
constexpr std::uint32_t reciprocal_q24(std::uint32_t n) {
    return ((1U << 24) + n) / (n + 1);
}

/// Returns 64 darkness / (paper + 1), rounded down.
std::size_t relative_darkness(int darkness, int paper) {
    return static_cast<std::size_t>(
        std::uint64_t{64} * static_cast<std::uint64_t>(darkness) *
            tabled<reciprocal_q24, 256>(static_cast<std::uint32_t>(paper)) >>
        24);
}

/// Returns the start of an interval of `length` px around `centre`, shifted into [0, size).
int begin_of(int centre, int length, int size) {
    return std::clamp(centre - length / 2, 0, size - length);
}

}  // namespace

bool place_patch(const ImageView& image, int centre_u_px, int centre_v_px, int width_px,
                 int height_px, int scale, Patch& patch) {
    patch.scale = scale;
    patch.width_px = std::min({width_px, image.width_px, Patch::kMaxWidth_px * scale}) / scale;
    patch.height_px = std::min({height_px, image.height_px, Patch::kMaxHeight_px * scale}) / scale;
    patch.left_px = begin_of(centre_u_px, patch.width_px * scale, image.width_px);
    patch.top_px = begin_of(centre_v_px, patch.height_px * scale, image.height_px);
    return std::min(patch.width_px, patch.height_px) >= patch.min_side_px;
}

bool measure_contrast(Patch& patch, DotTiles tiles) {
    const int columns = (patch.width_px + Patch::kTileWidth_px - 1) / Patch::kTileWidth_px;
    const int rows = (patch.height_px + Patch::kTileHeight_px - 1) / Patch::kTileHeight_px;
    const auto tile = [](int column, int row) {
        return static_cast<std::size_t>(row * Patch::kTilesPerRow + column);
    };
    // The last bin counts the tiles without contrast. The other bins count tiles by darkness
    // relative to the paper level, in units of 1/64.
    constexpr std::size_t kFlat = 65;
    std::array<int, kFlat + 1> counts{};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const int paper = patch.brightest[tile(column, row)];
            const int darkness = paper + patch.darkness[tile(column, row)] - 255;
            const bool is_dark = darkness >= tuned::kMinDarkness;
            ++counts[is_dark ? relative_darkness(darkness, paper) : kFlat];
        }
    }
    const int dark_tiles = rows * columns - counts[kFlat];
    const bool is_small = std::min(patch.width_px, patch.height_px) < tuned::kSmall_px;
    if (dark_tiles < (is_small ? rows * columns / 2 : tuned::kMinTiles)) return false;
    // Returns the smallest darkness d for which more than 1/`parts` of the tiles with contrast have
    // a darkness of at most d.
    const auto darkness_of_part = [&](int parts) {
        std::size_t darkness = 0;
        for (int below = counts[0]; parts * below <= dark_tiles; below += counts[++darkness]) {
        }
        return static_cast<int>(darkness);
    };
    const int median = darkness_of_part(2);
    int typical = median;
    if (tiles == DotTiles::pale) {
        typical = darkness_of_part(tuned::kPaleParts);
        if (static_cast<float>(typical) > tuned::kMaxPale * static_cast<float>(median))
            return false;
    }
    patch.dot_contrast_q8 = 4 * typical + 2;
    const int contrast_q16 = patch.dot_contrast_q8 * tuned::kThreshold_q8;
    for (int row = 0; row < rows; ++row) {
        // Computes the thresholds of the whole row, including unused tiles, because compilers
        // vectorise loops of constant length.
        const auto paper = std::span(patch.brightest).subspan(tile(0, row), Patch::kTilesPerRow);
        std::array<std::uint8_t, Patch::kTilesPerRow> thresholds;
        for (std::size_t i = 0; i < thresholds.size(); ++i)
            thresholds[i] = static_cast<std::uint8_t>(paper[i] - (paper[i] * contrast_q16 >> 16));
        // A strip is two tiles wide. If the last strip has only one tile, the missing tile gets the
        // threshold 0, which excludes all its pixels.
        if (columns % 2 != 0) thresholds[static_cast<std::size_t>(columns)] = 0;
        std::copy(thresholds.begin(), thresholds.end(),
                  patch.thresholds.begin() + static_cast<std::ptrdiff_t>(tile(0, row)));
    }
    return true;
}

void keep_isolated(Patch& patch) {
    constexpr int kAway_px = tuned::kAway_px;
    constexpr int kDiagonally_px = tuned::kDiagonally_px;
    constexpr std::array<std::array<int, 2>, 8> kAround{{{kAway_px, 0},
                                                         {-kAway_px, 0},
                                                         {0, kAway_px},
                                                         {0, -kAway_px},
                                                         {kDiagonally_px, kDiagonally_px},
                                                         {kDiagonally_px, -kDiagonally_px},
                                                         {-kDiagonally_px, kDiagonally_px},
                                                         {-kDiagonally_px, -kDiagonally_px}}};
    PatchDots& dots = patch.dots;
    const auto pixel_of = [&](float from_middle_px, int size_px) {
        const auto scale = static_cast<float>(patch.scale);
        const float at = from_middle_px / scale + static_cast<float>(size_px - 1) / 2 + 0.5F;
        return std::clamp(static_cast<int>(at), 0, size_px - 1);
    };
    std::size_t kept = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(dots.count); ++i) {
        // Skips minima on plateaus, where the fitted parabola has no vertex and the coordinates are
        // not finite.
        if (!(std::abs(dots.x[i]) < kNoDot_px && std::abs(dots.y[i]) < kNoDot_px)) continue;
        const int u = pixel_of(dots.x[i], patch.width_px);
        const int v = pixel_of(dots.y[i], patch.height_px);
        const auto tile = static_cast<std::size_t>(v / Patch::kTileHeight_px * Patch::kTilesPerRow +
                                                   u / Patch::kTileWidth_px);
        if (patch.brightest[tile] + patch.darkness[tile] - 255 < tuned::kMinDarkness) continue;
        const int threshold = patch.thresholds[tile];
        int dark = 0;
        for (const auto& [du, dv] : kAround) {
            const int x = std::clamp(u + du, 0, patch.width_px - 1);
            const int y = std::clamp(v + dv, 0, patch.height_px - 1);
            dark += patch.row(patch.smoothed, y)[x] < threshold ? 1 : 0;
        }
        if (dark > tuned::kMaxDark) continue;
        dots.x[kept] = dots.x[i];
        dots.y[kept++] = dots.y[i];
    }
    std::fill_n(dots.x.begin() + kept, 8, kNoDot_px);
    std::fill_n(dots.y.begin() + kept, 8, 0.0F);
    dots.count = static_cast<int>(kept);
}

float middle_u_px(const Patch& patch) {
    return static_cast<float>(2 * patch.left_px + patch.width_px * patch.scale - 1) / 2;
}
float middle_v_px(const Patch& patch) {
    return static_cast<float>(2 * patch.top_px + patch.height_px * patch.scale - 1) / 2;
}

}  // namespace dotpose::core
