// Tests the positions and thresholds of patches.
#include "core/detect/patch.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "../canvas.hpp"

namespace dotpose::core_test::patch_test {
namespace {

constexpr std::uint64_t kSeed = 74;

TEST(Patch, LiesAroundItsCentreWithinTheImage) {
    const auto patch = std::make_unique<Patch>();
    Rng rng(kSeed);
    for (int i = 0; i < 500; ++i) {
        const ImageView image{nullptr, 64 + static_cast<int>(rng.below(1000)),
                              64 + static_cast<int>(rng.below(1000)), 0};
        const int u = static_cast<int>(rng.below(static_cast<std::uint32_t>(image.width_px)));
        const int v = static_cast<int>(rng.below(static_cast<std::uint32_t>(image.height_px)));
        const int scale = 1 << rng.below(3);
        const bool is_large =
            core::place_patch(image, u, v, 224 * scale, 160 * scale, scale, *patch);
        EXPECT_EQ(patch->scale, scale);
        EXPECT_EQ(patch->width_px, std::min(224, image.width_px / scale));
        EXPECT_EQ(patch->height_px, std::min(160, image.height_px / scale));
        EXPECT_GE(patch->left_px, 0);
        EXPECT_GE(patch->top_px, 0);
        EXPECT_LE(patch->left_px + patch->width_px * scale, image.width_px);
        EXPECT_LE(patch->top_px + patch->height_px * scale, image.height_px);
        // The middle of the patch is at the requested pixel, unless the image border shifts the
        // patch.
        const double off_u = double{core::middle_u_px(*patch)} - u;
        if (patch->left_px > 0 && patch->left_px + patch->width_px * scale < image.width_px) {
            EXPECT_LE(std::abs(off_u), 1);
        }
        EXPECT_EQ(core::middle_u_px(*patch),
                  static_cast<float>(patch->left_px) +
                      static_cast<float>(patch->width_px * scale - 1) / 2);
        EXPECT_EQ(core::middle_v_px(*patch),
                  static_cast<float>(patch->top_px) +
                      static_cast<float>(patch->height_px * scale - 1) / 2);
        EXPECT_EQ(is_large, patch->width_px >= 48 && patch->height_px >= 48);
    }
}

TEST(Patch, IsNeverLargerThanItsMemory) {
    const auto patch = std::make_unique<Patch>();
    EXPECT_TRUE(core::place_patch({nullptr, 4096, 4096, 0}, 2048, 2048, 4000, 4000, 1, *patch));
    EXPECT_EQ(patch->width_px, Patch::kMaxWidth_px);
    EXPECT_EQ(patch->height_px, Patch::kMaxHeight_px);
}

/// Returns a patch in which all tiles have the paper level `paper` and the darkest pixel level
/// `darkest`.
std::unique_ptr<Patch> lit_patch(int width_px, int height_px, int paper, int darkest) {
    auto patch = std::make_unique<Patch>();
    patch->width_px = width_px;
    patch->height_px = height_px;
    patch->brightest.fill(static_cast<std::uint8_t>(paper));
    patch->darkness.fill(static_cast<std::uint8_t>(255 - darkest));
    return patch;
}

TEST(PatchContrast, IsThatOfTheTypicalTile) {
    for (const int darkest : {20, 60, 100, 140, 170}) {
        const auto patch = lit_patch(160, 96, 200, darkest);
        // A few black tiles and a few blank tiles must not change the result.
        for (std::size_t i = 0; i < 3; ++i)
            patch->darkness[i] = 255;
        for (std::size_t i = 5; i < 8; ++i)
            patch->darkness[i] = 55;
        ASSERT_TRUE(core::measure_contrast(*patch));
        EXPECT_NEAR(patch->dot_contrast_q8, 256.0 * (200 - darkest) / 200, 4.1);
        // The threshold is darker than the paper by 150 / 256 of the contrast.
        const double depth = (200 - darkest) / 200.0;
        EXPECT_NEAR(patch->thresholds[2], 200 * (1 - depth * 150 / 256), 3);
    }
}

TEST(PatchContrast, PaleTilesAreThoseOfDotsAmongGraphics) {
    const auto patch = lit_patch(160, 96, 200, 130);
    EXPECT_FALSE(core::measure_contrast(*patch, core::DotTiles::pale));  // no graphics
    // Graphics cover 7 of the 12 rows of tiles.
    for (std::size_t row = 0; row < 7; ++row) {
        for (std::size_t column = 0; column < 10; ++column)
            patch->darkness[row * Patch::kTilesPerRow + column] = 255 - 30;
    }
    ASSERT_TRUE(core::measure_contrast(*patch));
    EXPECT_NEAR(patch->dot_contrast_q8, 256.0 * 170 / 200, 4.1);
    ASSERT_TRUE(core::measure_contrast(*patch, core::DotTiles::pale));
    EXPECT_NEAR(patch->dot_contrast_q8, 256.0 * 70 / 200, 4.1);
}

TEST(PatchContrast, ThresholdsFollowTheLight) {
    const auto patch = lit_patch(160, 96, 200, 100);
    for (std::size_t row = 6; row < 12; ++row) {
        for (std::size_t column = 0; column < 10; ++column) {
            patch->brightest[row * Patch::kTilesPerRow + column] = 80;
            patch->darkness[row * Patch::kTilesPerRow + column] = 255 - 40;
        }
    }
    ASSERT_TRUE(core::measure_contrast(*patch));
    EXPECT_NEAR(patch->thresholds[0], 200 * (1 - 0.5 * 150 / 256), 3);
    EXPECT_NEAR(patch->thresholds[8 * Patch::kTilesPerRow], 80 * (1 - 0.5 * 150 / 256), 2);
}

TEST(PatchContrast, WhatIsBlankHasNone) {
    EXPECT_FALSE(core::measure_contrast(*lit_patch(160, 96, 200, 195)));
    EXPECT_FALSE(core::measure_contrast(*lit_patch(160, 96, 0, 0)));
    // A patch is blank if only a few of its tiles contain dark pixels.
    const auto patch = lit_patch(160, 96, 200, 199);
    for (std::size_t i = 0; i < 10; ++i)
        patch->darkness[i] = 200;
    EXPECT_FALSE(core::measure_contrast(*patch));
}

TEST(KeepIsolated, DropsMinimaThatHaveNoFinitePlace) {
    const auto patch = lit_patch(160, 96, 200, 100);
    ASSERT_TRUE(core::measure_contrast(*patch));
    for (int v = 0; v < patch->height_px; ++v)
        std::fill_n(patch->row(patch->smoothed, v), patch->width_px, std::uint8_t{200});
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    constexpr float kFar = std::numeric_limits<float>::infinity();
    const std::array<std::array<float, 2>, 6> places{
        {{kNone, 3}, {5, 7}, {3, kNone}, {kFar, 1}, {2, -kFar}, {-20, 9}}};
    patch->dots.count = static_cast<int>(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        patch->dots.x[i] = places[i][0];
        patch->dots.y[i] = places[i][1];
    }
    core::keep_isolated(*patch);
    ASSERT_EQ(patch->dots.count, 2);
    EXPECT_EQ(patch->dots.x[0], 5);
    EXPECT_EQ(patch->dots.y[1], 9);
}

}  // namespace
}  // namespace dotpose::core_test::patch_test
