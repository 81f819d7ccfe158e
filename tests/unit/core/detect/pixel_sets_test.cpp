// Tests that blobs consist of exactly the pixels that are darker than the threshold of their tile.
#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core_test::pixel_sets_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 52;

/// A set of connected dark pixels.
struct Set {
    int area_px = 0;
    int left, top, right, bottom;
    bool passes_high = false;
};

/// The pixels of an image, marked according to the low and the high threshold of their tiles.
struct Marked {
    std::vector<char> is_dark;
    std::vector<char> is_below_high;
};

Marked marked(const GreyImage& image, AdaptiveThreshold& threshold) {
    Marked result;
    result.is_dark.resize(image.pixels.size());
    result.is_below_high.resize(image.pixels.size());
    begin_threshold(image.width_px, image.height_px, threshold);
    int band = 0;
    for (int row = 0; row < image.height_px; ++row) {
        for (int ready = take_row(image.view().row(row), threshold); ready > 0; --ready, ++band) {
            measure_levels(band, {}, threshold);
            for (int v = band_begin(threshold, band); v < band_end(threshold, band); ++v) {
                for (int u = 0; u < image.width_px; ++u) {
                    const auto p = static_cast<std::size_t>(v * image.width_px + u);
                    const Levels level = levels_at(threshold, u);
                    result.is_dark[p] = image.pixels[p] < level.low;
                    result.is_below_high[p] = image.pixels[p] < level.high;
                }
            }
        }
    }
    return result;
}

Set flood(Marked& pixels, int width, int height, int u, int v) {
    Set found{0, u, v, u, v, false};
    std::vector<FixedVec> open{{u, v}};
    const auto take = [&](int x, int y) {
        char& is_dark = pixels.is_dark[static_cast<std::size_t>(y * width + x)];
        return std::exchange(is_dark, char{0}) != 0;
    };
    take(u, v);
    while (!open.empty()) {
        const FixedVec p = open.back();
        open.pop_back();
        ++found.area_px;
        found.left = std::min(found.left, p.x);
        found.right = std::max(found.right, p.x);
        found.top = std::min(found.top, p.y);
        found.bottom = std::max(found.bottom, p.y);
        found.passes_high |= pixels.is_below_high[static_cast<std::size_t>(p.y * width + p.x)] != 0;
        for (int y = std::max(p.y - 1, 0); y <= std::min(p.y + 1, height - 1); ++y) {
            for (int x = std::max(p.x - 1, 0); x <= std::min(p.x + 1, width - 1); ++x) {
                if (take(x, y)) open.push_back({x, y});
            }
        }
    }
    return found;
}

/// Returns the sets that do not touch the border of the image and contain a pixel below the high
/// threshold.
std::vector<Set> expected_sets(const GreyImage& image, AdaptiveThreshold& threshold) {
    Marked pixels = marked(image, threshold);
    std::vector<Set> sets;
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u) {
            if (pixels.is_dark[static_cast<std::size_t>(v * image.width_px + u)] == 0) continue;
            const Set set = flood(pixels, image.width_px, image.height_px, u, v);
            const bool at_border = set.left == 0 || set.top == 0 ||
                                   set.right == image.width_px - 1 ||
                                   set.bottom == image.height_px - 1;
            if (set.passes_high && !at_border) sets.push_back(set);
        }
    }
    return sets;
}

void expect_sets(const GreyImage& image) {
    static LargeWorkspace workspace;
    const auto sets = expected_sets(image, workspace.threshold);
    const auto dots = blobs_of(image, workspace);
    ASSERT_GT(sets.size(), 20u);
    ASSERT_EQ(dots.size(), sets.size());
    for (const Set& set : sets) {
        const auto is_it = [&](const DetectedDot& dot) {
            const Vec2 centre = real(dot.centre_q8, 8);
            return dot.area_px == set.area_px && centre.x >= set.left - 0.01 &&
                   centre.x <= set.right + 0.01 && centre.y >= set.top - 0.01 &&
                   centre.y <= set.bottom + 0.01;
        };
        ASSERT_TRUE(std::any_of(dots.begin(), dots.end(), is_it))
            << set.area_px << " px from " << set.left << ", " << set.top;
    }
}

TEST(PixelSets, AreThoseDarkerThanTheirTilesLevel) {
    // The grey levels are random, and include levels just above and below the thresholds. The
    // lighting is uneven.
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        const int width = 64 + static_cast<int>(rng.below(260));
        const int height = 64 + static_cast<int>(rng.below(260));
        SCOPED_TRACE(testing::Message()
                     << "image " << i << ", seed " << kSeed << ", " << width << " x " << height);
        GreyImage image = blank(width, height);
        for (int v = 3; v + 4 < height; v += 7) {
            for (int u = 3; u + 4 < width; u += 7) {
                const auto at = Vec2{u + rng.uniform(0, 3), v + rng.uniform(0, 3)};
                darken(image, at, rng.uniform(0.7, 1.3), rng.uniform(0.3, 0.8));
            }
        }
        const double fall = rng.uniform(0, 0.6);
        for (int v = 0; v < height; ++v) {
            for (int u = 0; u < width; ++u) {
                std::uint8_t& level = pixel(image, u, v);
                const double lit = level * (1 - fall * u / width) + rng.normal() * 2;
                level = static_cast<std::uint8_t>(std::clamp(std::lround(lit), 0L, 255L));
            }
        }
        expect_sets(image);
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(PixelSets, RunsBeginAndEndAtAnyColumn) {
    // Draws eight rows of bars for each length. The rows begin at eight successive columns, and the
    // bars in a row are separated by one pixel.
    for (int length = 2; length <= 26; ++length) {
        GreyImage image = blank(200, 140);
        std::size_t bars = 0;
        for (int first = 0; first < 8; ++first) {
            const int v = 5 + 16 * first;
            for (int u = 40 + first; u + length < 160; u += length + 1, ++bars)
                fill(image, u, v, u + length, v + 2, 30);
        }
        const auto dots = blobs_of(image);
        ASSERT_EQ(dots.size(), bars) << length;
        for (const DetectedDot& dot : dots)
            ASSERT_EQ(dot.area_px, 2 * length);
    }
}

}  // namespace
}  // namespace dotpose::core_test::pixel_sets_test
