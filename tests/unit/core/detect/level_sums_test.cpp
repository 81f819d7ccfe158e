// Tests sums of grey levels over boxes against sums computed pixel by pixel.
#include "core/detect/level_sums.hpp"

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::level_sums_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 66;

TEST(LevelSums, AreThoseOfThePixels) {
    Rng rng(kSeed);
    GreyImage image = blank(64, 70);
    for (int v = 0; v < 70; ++v) {
        for (int u = 0; u < 64; ++u)
            pixel(image, u, v) = static_cast<std::uint8_t>(rng.below(256));
    }
    const auto random_q8 = [&](int max_px) {
        return static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(256 * max_px)));
    };
    constexpr int kHalf_px = (LevelSums::kMaxSide_px - 1) / 2;
    for (int i = 0; i < 500; ++i) {
        SCOPED_TRACE(testing::Message() << "box " << i << ", seed " << kSeed);
        const FixedVec middle_q8{random_q8(63), random_q8(69)};
        const LevelSums sums(image.view(), PixelBox(image.view(), middle_q8, kHalf_px));
        const FixedVec inside_q8{middle_q8.x + random_q8(20) - 2560,
                                 middle_q8.y + random_q8(20) - 2560};
        const PixelBox box(image.view(), inside_q8, static_cast<int>(rng.below(13)));
        int expected = 0;
        int pixels = 0;
        for (int v = box.top; v <= box.bottom; ++v) {
            for (int u = box.left; u <= box.right; ++u, ++pixels)
                expected += image.view().row(v)[u];
        }
        EXPECT_EQ(box.pixels(), pixels);
        if (pixels > 0) {
            EXPECT_EQ(sums.of(box), expected);
        }
    }
}

TEST(PixelBox, HasNothingOutsideTheImage) {
    const GreyImage image = blank(64, 70);
    EXPECT_EQ(PixelBox(image.view(), {-5 * 256, 20 * 256}, 4).pixels(), 0);
    EXPECT_EQ(PixelBox(image.view(), {-5 * 256, 20 * 256}, 5).pixels(), 11);
    EXPECT_EQ(PixelBox(image.view(), {20 * 256 + 127, 75 * 256}, 5).pixels(), 0);
    EXPECT_EQ(PixelBox(image.view(), {20 * 256 + 128, 30 * 256}, 1).left, 20);
}

}  // namespace
}  // namespace dotpose::core_test::level_sums_test
