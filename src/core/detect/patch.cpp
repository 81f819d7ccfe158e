#include "core/detect/patch.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace dotpose::core {
namespace {

/// Fewest px of a patch's side: 8 dots, 6 px apart.
constexpr int kFewest_px = 48;
/// Darkness of a smoothed dot, in grey levels, below which a tile counts as blank.
constexpr int kLeastDarkness = 12;
constexpr int kFewestTiles = 12;
/// Minima lighter than this share of the typical dot's darkness, in 1/256, are noise.
constexpr int kThreshold_q8 = 150;

/// 2^24 / (n + 1), rounded up: a division for each tile takes a microsecond.
constexpr auto kReciprocals_q24 = [] {
    std::array<std::uint32_t, 256> result{};
    for (std::uint32_t n = 0; n < result.size(); ++n)
        result[n] = ((1U << 24) + n) / (n + 1);
    return result;
}();

/// 64 darkness / (paper + 1), exactly.
std::size_t relative_darkness(int darkness, int paper) {
    return static_cast<std::size_t>(std::uint64_t{64} * static_cast<std::uint64_t>(darkness) *
                                        kReciprocals_q24[static_cast<std::size_t>(paper)] >>
                                    24);
}

/// Where a stretch of so many px begins that lies around `centre`, within [0, size).
int begin_of(int centre, int length, int size) {
    return std::clamp(centre - length / 2, 0, size - length);
}

}  // namespace

bool place_patch(const ImageView& image, int centre_u_px, int centre_v_px, int width_px,
                 int height_px, int scale, Patch& patch) {
    patch.scale = scale;
    patch.width_px = std::min({width_px, image.width_px, Patch::kMostWidth_px * scale}) / scale;
    patch.height_px = std::min({height_px, image.height_px, Patch::kMostHeight_px * scale}) / scale;
    patch.left_px = begin_of(centre_u_px, patch.width_px * scale, image.width_px);
    patch.top_px = begin_of(centre_v_px, patch.height_px * scale, image.height_px);
    return patch.width_px >= kFewest_px && patch.height_px >= kFewest_px;
}

bool measure_contrast(Patch& patch) {
    const int columns = (patch.width_px + Patch::kTileWidth_px - 1) / Patch::kTileWidth_px;
    const int rows = (patch.height_px + Patch::kTileHeight_px - 1) / Patch::kTileHeight_px;
    const auto tile = [](int column, int row) {
        return static_cast<std::size_t>(row * Patch::kTilesPerRow + column);
    };
    // How many tiles have each darkness, relative to their paper, in 1/64.
    std::array<int, 65> counts{};
    int dark_tiles = 0;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const int paper = patch.brightest[tile(column, row)];
            const int darkness = paper + patch.darkness[tile(column, row)] - 255;
            if (darkness < kLeastDarkness) continue;
            ++counts[relative_darkness(darkness, paper)];
            ++dark_tiles;
        }
    }
    if (dark_tiles < kFewestTiles) return false;
    std::size_t median = 0;
    for (int below = counts[0]; 2 * below <= dark_tiles; below += counts[++median]) {
    }
    patch.depth_q8 = 4 * static_cast<int>(median) + 2;
    const int share_q16 = patch.depth_q8 * kThreshold_q8;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const int paper = patch.brightest[tile(column, row)];
            patch.thresholds[tile(column, row)] =
                static_cast<std::uint8_t>(paper - (paper * share_q16 >> 16));
        }
        // Strips have two tiles: nothing is darker than that of the last one.
        if (columns % 2 != 0) patch.thresholds[tile(columns, row)] = 0;
    }
    return true;
}

float middle_u_px(const Patch& patch) {
    return static_cast<float>(2 * patch.left_px + patch.width_px * patch.scale - 1) / 2;
}
float middle_v_px(const Patch& patch) {
    return static_cast<float>(2 * patch.top_px + patch.height_px * patch.scale - 1) / 2;
}

}  // namespace dotpose::core
