#include "core/pixels/light.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace dotpose::core {
namespace {

constexpr int kBandsKept = 3;
constexpr int kContrastBins = 64;

std::span<Tile> tiles_of(const Light& light, int band) {
    const auto n = static_cast<std::size_t>(light.tiles_per_band);
    return light.tiles.subspan(static_cast<std::size_t>(band % kBandsKept) * n, n);
}

void add_to_tiles(const std::uint8_t* pixels, const Light& light, std::span<Tile> tiles) {
    int u = 0;
    for (Tile& tile : tiles) {
        const int end = std::min(u + light.tile_px, light.width_px);
        unsigned sum = 0;
        std::uint8_t darkest = 255;
        std::uint8_t before = 255;
        for (; u < end; ++u) {
            // Dark is what two pixels side by side agree on: a defect pixel is no ink.
            sum += pixels[u];
            darkest = std::min(darkest, std::max(before, pixels[u]));
            before = pixels[u];
        }
        tile.sum = static_cast<std::uint16_t>(tile.sum + sum);
        tile.darkest = std::min(tile.darkest, darkest);
    }
}

void close_tiles(int rows, const Light& light, std::span<Tile> tiles) {
    int u = 0;
    for (Tile& tile : tiles) {
        const int end = std::min(u + light.tile_px, light.width_px);
        tile.mean = static_cast<std::uint8_t>(tile.sum / ((end - u) * rows));
        u = end;
    }
}

/// Brightest mean and darkest pixel of the 3 x 3 tiles around one.
Tile surroundings(const Light& light, int band, int tile) {
    Tile found{0, 0, 255};
    for (int b = std::max(band - 1, 0); b <= std::min(band + 1, band_count(light) - 1); ++b) {
        const std::span<Tile> tiles = tiles_of(light, b);
        const int last = std::min(tile + 1, light.tiles_per_band - 1);
        for (int t = std::max(tile - 1, 0); t <= last; ++t) {
            const Tile& near = tiles[static_cast<std::size_t>(t)];
            found.mean = std::max(found.mean, near.mean);
            found.darkest = std::min(found.darkest, near.darkest);
        }
    }
    return found;
}

}  // namespace

void begin_light(int width_px, int height_px, Light& light) {
    light.width_px = width_px;
    light.height_px = height_px;
    light.tile_px = std::min(width_px, height_px) <= kLargestFinelyTiled_px ? kSmallestTile_px
                                                                            : kLargestTile_px;
    light.tiles_per_band = (width_px + light.tile_px - 1) / light.tile_px;
    light.rows_taken = 0;
    light.has_contrast = false;
}

int take_row(const std::uint8_t* pixels, Light& light) {
    const int v = light.rows_taken++;
    const int band = v / light.tile_px;
    const std::span<Tile> tiles = tiles_of(light, band);
    if (v == band_begin(light, band)) std::fill(tiles.begin(), tiles.end(), Tile{});
    std::memcpy(kept_row(light, v), pixels, static_cast<std::size_t>(light.width_px));
    add_to_tiles(pixels, light, tiles);
    if (v + 1 < band_end(light, band)) return 0;
    close_tiles(v + 1 - band_begin(light, band), light, tiles);
    const int above = band > 0 ? 1 : 0;
    return v + 1 == light.height_px ? above + 1 : above;
}

void measure_levels(int band, const ThresholdOptions& options, Light& light) {
    const auto levels = light.levels.first(static_cast<std::size_t>(light.tiles_per_band));
    // Ink reflects the same share of the light everywhere, and so the relative contrast of the dots
    // is the same for all tiles. Strokes of graphics raise that of the tiles around them: the lower
    // third over a band is that of dots even where strokes cross it.
    std::array<std::uint16_t, kContrastBins> histogram{};
    int count = 0;
    for (int t = 0; t < light.tiles_per_band; ++t) {
        const Tile near = surroundings(light, band, t);
        const int contrast = near.mean - near.darkest;
        Levels& level = levels[static_cast<std::size_t>(t)];
        level = Levels{};
        if (contrast < options.min_contrast) continue;
        ++histogram[static_cast<std::size_t>(contrast * kContrastBins / (near.mean + 1))];
        level.paper = near.mean;
        light.has_contrast = true;
        ++count;
    }
    int bin = 0;
    for (int below = 0; bin < kContrastBins - 1; ++bin) {
        below += histogram[static_cast<std::size_t>(bin)];
        if (10 * below > 3 * count) break;
    }
    for (Levels& level : levels) {
        if (level.paper == 0) continue;
        const int depth_q8 = level.paper * (2 * bin + 1) * 256 / (2 * kContrastBins);
        level.extent =
            static_cast<std::uint8_t>(level.paper - depth_q8 * options.extent_q8 / 65536);
        level.core = static_cast<std::uint8_t>(level.paper - depth_q8 * options.core_q8 / 65536);
    }
}

}  // namespace dotpose::core
