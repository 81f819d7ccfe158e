// Tiles against plain arithmetic, on noise.
#include "core/pixels/tiles.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "../canvas.hpp"

namespace dotpose::core_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 71;

/// The mean over every fourth row about the middle, and of every second row the darkest of what two
/// pixels side by side agree on, in steps of two grey levels. Rows go on after the last column.
Tile expected_tile(const Light& light, int band, int tile) {
    const int begin = band_begin(light, band);
    const int end = band_end(light, band);
    int sum = 0;
    int pixels = 0;
    int darkest = 255;
    for (int u = tile * light.tile_px; u < (tile + 1) * light.tile_px; ++u) {
        for (int v = end - begin > 2 ? begin + 2 : begin; v < end; v += 4, ++pixels)
            sum += kept_row(light, v)[u];
        for (int v = begin; v < end; v += 2) {
            const std::uint8_t* row = kept_row(light, v);
            darkest = std::min<int>(darkest, std::max(row[u - 1], row[u]));
        }
    }
    return {static_cast<std::uint8_t>(sum / pixels),
            static_cast<std::uint8_t>(255 - darkest / 2 * 2)};
}

TEST(Tiles, AreMeasuredAlikeInAllWays) {
    LargeWorkspace w;
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        const int width = 64 + static_cast<int>(rng.below(i % 10 == 0 ? 4033 : 300));
        const int height = 64 + static_cast<int>(rng.below(250));
        SCOPED_TRACE(testing::Message()
                     << "image " << i << ", seed " << kSeed << ", " << width << " x " << height);
        const int spread = 1 + static_cast<int>(rng.below(255));
        std::vector<std::uint8_t> row(static_cast<std::size_t>(width));
        begin_light(width, height, w.light);
        std::vector<Tile> tiles(static_cast<std::size_t>(w.light.tiles_per_band));
        for (int v = 0; v < height; ++v) {
            for (std::uint8_t& level : row)
                level = static_cast<std::uint8_t>(255 - rng.below(static_cast<unsigned>(spread)));
            take_row(row.data(), w.light);
            const int band = v / w.light.tile_px;
            if (v + 1 != band_end(w.light, band)) continue;
            for (const auto measure : {measure_tiles, measure_tiles_by_word}) {
                measure(band, w.light, tiles);
                for (int t = 0; t < w.light.tiles_per_band; ++t) {
                    const Tile tile = tiles[static_cast<std::size_t>(t)];
                    const Tile expected = expected_tile(w.light, band, t);
                    ASSERT_EQ(tile.mean, expected.mean) << "tile " << t << ", band " << band;
                    ASSERT_EQ(tile.darkness, expected.darkness) << t << ", band " << band;
                }
            }
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test
