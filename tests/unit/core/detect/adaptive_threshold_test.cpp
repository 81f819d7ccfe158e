// Tests the paper levels and the thresholds of tiles.
#include "core/detect/adaptive_threshold.hpp"

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core_test::adaptive_threshold_test {
namespace {

using namespace core;

/// Returns an image of uniform paper with a dark square of 2 x 2 px in every block of 8 x 8 px.
/// Only some rows of a tile are measured, and each square intersects one of these rows.
GreyImage dotted(int width_px, int height_px, int paper, int ink) {
    GreyImage image = blank(width_px, height_px, paper);
    for (int v = 2; v + 2 <= height_px; v += 8) {
        for (int u = 2; u + 2 <= width_px; u += 8)
            fill(image, u, v, u + 2, v + 2, ink);
    }
    return image;
}

/// Calls `visit(band)` for every band, as soon as the rows that the band needs have been received.
template <typename Visit>
void for_each_band(const GreyImage& image, const ThresholdOptions& options,
                   AdaptiveThreshold& threshold, Visit visit) {
    begin_threshold(image.width_px, image.height_px, threshold);
    int next = 0;
    for (int v = 0; v < image.height_px; ++v) {
        const int ready = take_row(image.view().row(v), threshold);
        ASSERT_GE(ready, 0);
        for (int i = 0; i < ready; ++i, ++next) {
            // When a band is ready, all its rows and all rows of the band below it must have been
            // received.
            ASSERT_LE(std::min(band_end(threshold, next + 1), image.height_px), v + 1);
            measure_levels(next, options, threshold);
            visit(next);
        }
    }
    ASSERT_EQ(next, band_count(threshold));
}

TEST(AdaptiveThreshold, EveryBandBecomesReadyOnceWhateverTheHeight) {
    LargeWorkspace w;
    for (const auto& [width, heights] : {std::pair{64, 64}, std::pair{300, 250}}) {
        for (int height = heights; height < heights + 35; ++height) {
            SCOPED_TRACE(testing::Message() << width << " x " << height);
            const GreyImage image = blank(width, height);
            int covered = 0;
            for_each_band(image, {}, w.threshold, [&](int band) {
                EXPECT_EQ(band_begin(w.threshold, band), covered);
                covered = band_end(w.threshold, band);
                // All rows of the band must still be stored.
                for (int v = band_begin(w.threshold, band); v < covered; ++v) {
                    EXPECT_EQ(kept_row(w.threshold, v)[image.width_px - 1], 200);
                }
            });
            EXPECT_EQ(covered, height);
        }
    }
}

TEST(AdaptiveThreshold, ThresholdsLieAtTheirSharesOfTheContrast) {
    SmallWorkspace w;
    const ThresholdOptions options;
    for (const auto& [paper, ink] : {std::pair{200, 30}, std::pair{255, 0}, std::pair{90, 20},
                                     std::pair{60, 40}, std::pair{230, 150}}) {
        SCOPED_TRACE(testing::Message() << "paper " << paper << ", ink " << ink);
        for_each_band(dotted(128, 80, paper, ink), options, w.threshold,
                      [&, p = paper, i = ink](int) {
                          for (int t = 0; t < 8; ++t) {
                              const Levels level = levels_of_tile(w.threshold, t);
                              // Only the third and the seventh row of a tile are measured. Ink
                              // covers a quarter of the third row and none of the seventh, so it
                              // covers an eighth of the measured pixels.
                              const double mean = std::floor(p - (p - i) / 8.0);
                              // The contrast is rounded to 1/64 of the paper level.
                              const double step = mean / 64 + 1;
                              const double low = mean - (mean - i) * options.low_q8 / 256;
                              const double high = mean - (mean - i) * options.high_q8 / 256;
                              // The low threshold is rounded down to an even level.
                              ASSERT_NEAR(level.low, low - 0.5, step * options.low_q8 / 256 + 2);
                              ASSERT_EQ(level.low % 2, 0);
                              ASSERT_NEAR(level.high, high, step * options.high_q8 / 256 + 1.5);
                          }
                      });
    }
}

TEST(AdaptiveThreshold, LevelsAreTheSameInAllColumnsOfATile) {
    LargeWorkspace w;
    // The images have tiles of different heights, and tiles that extend beyond the border. The
    // brightness changes from tile to tile.
    for (const auto& [width, height] :
         {std::pair{120, 80}, std::pair{101, 64}, std::pair{400, 256}, std::pair{397, 250}}) {
        SCOPED_TRACE(testing::Message() << width << " x " << height);
        GreyImage image = dotted(width, height, 220, 40);
        for (int v = 0; v < height; ++v) {
            for (int u = 0; u < width; ++u) {
                std::uint8_t& level = pixel(image, u, v);
                level = static_cast<std::uint8_t>(level * (2 * width - u) / (2 * width));
            }
        }
        for_each_band(image, {}, w.threshold, [&](int) {
            for (int u = 0; u < whole_width(w.threshold); ++u) {
                const Levels of_tile = levels_of_tile(w.threshold, u / kTileWidth_px);
                const Levels here = levels_at(w.threshold, u);
                ASSERT_EQ(here.low, of_tile.low) << "column " << u;
                ASSERT_EQ(here.high, of_tile.high) << "column " << u;
            }
            EXPECT_GT(levels_of_tile(w.threshold, 0).low, levels_of_tile(w.threshold, 5).low);
            EXPECT_GT(levels_of_tile(w.threshold, 0).high, levels_of_tile(w.threshold, 5).high);
        });
    }
}

TEST(AdaptiveThreshold, RowsAreFilledUpToWholeTiles) {
    LargeWorkspace w;
    for (const int width : {64, 65, 71, 72, 93}) {
        GreyImage image = blank(width, 70);
        for (int v = 0; v < 70; ++v) {
            for (int u = 0; u < width; ++u)
                pixel(image, u, v) = static_cast<std::uint8_t>(u + v);
        }
        for_each_band(image, {}, w.threshold, [&](int band) {
            for (int v = band_begin(w.threshold, band); v < band_end(w.threshold, band); ++v) {
                const std::uint8_t* row = kept_row(w.threshold, v);
                EXPECT_EQ(reinterpret_cast<std::uintptr_t>(row) % 8, 0u);
                for (int u = 0; u < (width + 15) / 16 * 16; ++u)
                    ASSERT_EQ(row[u], std::min(u, width - 1) + v) << u << ", " << v;
            }
        });
    }
}

TEST(AdaptiveThreshold, ADefectPixelIsHalfAsDarkAsInk) {
    SmallWorkspace w;
    for (int u = 30; u < 38; ++u) {
        for (const int width : {1, 2}) {
            GreyImage image = blank(120, 80);
            fill(image, u, 34, u + width, 35, 20);
            // The contrast of a tile is measured with pairs of adjacent pixels, the first of which
            // is in an even column. The ink is 180 levels darker than the paper, so a pair with one
            // dark pixel has a contrast of about 90.
            for (const int min_contrast : {70, 100}) {
                int dark_tiles = 0;
                for_each_band(image, {.min_contrast = min_contrast}, w.threshold, [&](int) {
                    for (int t = 0; t < w.threshold.tiles_per_band; ++t)
                        dark_tiles += levels_of_tile(w.threshold, t).low > 0;
                });
                const bool is_pair = width == 2 && u % 2 == 0;
                // The tile that contains the mark and its eight neighbours are treated as dark. If
                // the mark is on the border between two tiles, both tiles and their ten neighbours
                // are treated as dark.
                const bool is_split = width == 2 && u == 31;
                EXPECT_EQ(dark_tiles, min_contrast == 100 && !is_pair ? 0
                                      : is_split                      ? 12
                                                                      : 9)
                    << "column " << u;
            }
        }
    }
}

TEST(AdaptiveThreshold, BlankAreasHaveNoInk) {
    SmallWorkspace w;
    for (const int level : {0, 1, 7, 100, 255}) {
        for_each_band(blank(100, 70, level), {}, w.threshold, [&](int) {
            for (int t = 0; t < w.threshold.tiles_per_band; ++t) {
                EXPECT_EQ(levels_of_tile(w.threshold, t).low, 0) << level;
            }
        });
    }
    // If the contrast of the ink is below the minimum, all tiles are blank. Otherwise, all tiles
    // are blank except those near the ink.
    ThresholdOptions options;
    options.min_contrast = 20;
    for (const int ink : {185, 150}) {
        GreyImage image = blank(120, 80);
        fill(image, 18, 18, 20, 20, ink);
        for_each_band(image, options, w.threshold, [&](int band) {
            for (int t = 0; t < w.threshold.tiles_per_band; ++t) {
                const bool is_near = std::abs(t - 1) <= 1 && std::abs(band - 2) <= 1;
                EXPECT_EQ(levels_of_tile(w.threshold, t).low > 0, is_near && ink == 150)
                    << "tile " << t << ", band " << band << ", ink " << ink;
            }
        });
    }
}

TEST(AdaptiveThreshold, WhatIsAsPaleAsNoiseIsBlankOnceOthersShowInk) {
    SmallWorkspace w;
    ThresholdOptions options;
    options.min_contrast = 8;
    // From top to bottom, the image contains a pale spot, a spot of ink, and another pale spot. The
    // contrast of the pale spots is as low as that of noise.
    GreyImage image = blank(120, 120);
    fill(image, 18, 18, 20, 20, 190);
    fill(image, 98, 50, 100, 52, 80);
    fill(image, 18, 98, 20, 100, 190);
    int inked_above = 0;
    int inked_below = 0;
    for_each_band(image, options, w.threshold, [&](int band) {
        if (levels_of_tile(w.threshold, 1).low == 0) return;
        ++(band_begin(w.threshold, band) < 50 ? inked_above : inked_below);
    });
    EXPECT_GT(inked_above, 0);
    EXPECT_EQ(inked_below, 0);
}

TEST(AdaptiveThreshold, ThresholdsFollowAShadow) {
    // The right half of the image is a third as bright as the left half.
    SmallWorkspace w;
    GreyImage image = dotted(160, 80, 210, 30);
    for (int v = 0; v < 80; ++v) {
        for (int u = 80; u < 160; ++u)
            pixel(image, u, v) = static_cast<std::uint8_t>(pixel(image, u, v) / 3);
    }
    for_each_band(image, {}, w.threshold, [&](int) {
        for (const int t : {0, 2, 4}) {
            const Levels level = levels_of_tile(w.threshold, t);
            EXPECT_GT(level.high, 30);
            EXPECT_LT(level.low, 210);
        }
        for (const int t : {6, 7, 9}) {
            const Levels level = levels_of_tile(w.threshold, t);
            EXPECT_GT(level.high, 10);
            EXPECT_LT(level.low, 70);
        }
    });
}

}  // namespace
}  // namespace dotpose::core_test::adaptive_threshold_test
