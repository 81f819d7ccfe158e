// Tests the measurement of tiles in noise images against a simple reference computation.
#include "core/detect/tiles.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core_test::tiles_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 71;

/// Computes the mean level and the darkest pair of pixels in every fourth row of the tile. A pair
/// consists of two adjacent pixels, the first of which is in an even column. The stored rows extend
/// beyond the image to the end of the last tile.
Tile expected_tile(const AdaptiveThreshold& threshold, int band, int tile) {
    const int begin = band_begin(threshold, band);
    const int end = band_end(threshold, band);
    int sum = 0;
    int pixels = 0;
    int darkest = 255;
    for (int v = end - begin > 2 ? begin + 2 : begin; v < end; v += 4) {
        const std::uint8_t* row = kept_row(threshold, v);
        for (int u = tile * kTileWidth_px; u < (tile + 1) * kTileWidth_px; u += 2, pixels += 2) {
            const int pair = row[u] + row[u + 1];
            sum += pair;
            darkest = std::min(darkest, pair / 2);
        }
    }
    return {static_cast<std::uint8_t>(sum / pixels), static_cast<std::uint8_t>(255 - darkest)};
}

TEST(Tiles, AreMeasuredInPairsOfPixels) {
    LargeWorkspace w;
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        const int width = 64 + static_cast<int>(rng.below(i % 10 == 0 ? 4033 : 300));
        const int height = 64 + static_cast<int>(rng.below(250));
        SCOPED_TRACE(testing::Message()
                     << "image " << i << ", seed " << kSeed << ", " << width << " x " << height);
        const int spread = 1 + static_cast<int>(rng.below(255));
        std::vector<std::uint8_t> row(static_cast<std::size_t>(width));
        begin_threshold(width, height, w.threshold);
        std::vector<Tile> tiles(static_cast<std::size_t>(w.threshold.tiles_per_band));
        for (int v = 0; v < height; ++v) {
            for (std::uint8_t& level : row)
                level = static_cast<std::uint8_t>(255 - rng.below(static_cast<unsigned>(spread)));
            take_row(row.data(), w.threshold);
            const int band = v / w.threshold.band_px;
            if (v + 1 != band_end(w.threshold, band)) continue;
            measure_tiles(band, w.threshold, tiles);
            for (int t = 0; t < w.threshold.tiles_per_band; ++t) {
                const Tile tile = tiles[static_cast<std::size_t>(t)];
                const Tile expected = expected_tile(w.threshold, band, t);
                ASSERT_EQ(tile.mean, expected.mean) << "tile " << t << ", band " << band;
                ASSERT_EQ(tile.darkness, expected.darkness) << t << ", band " << band;
            }
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test::tiles_test
