// Tests that small views are located if the rate of misread bits is known.
#include <memory>

#include <gtest/gtest.h>

#include "shots.hpp"

namespace dotpose::core_test::error_rate_test {
namespace {

constexpr std::uint64_t kSeed = 4243;

/// Returns the number of located frames of 96 x 96 px. Expects all fixes to be correct.
int located(int bits_per_error, int frames) {
    DeviceOptions options;
    options.integrity.bits_per_error = bits_per_error;
    const auto memory = std::make_unique<LargeMemory>();
    Locator locator(*memory, options);
    int count = 0;
    for (int i = 0; i < frames; ++i) {
        const Shot shot =
            shot_of({.width_px = 96, .height_px = 96}, kSeed, static_cast<std::uint64_t>(i));
        const Fix fix = locator.locate(render(shot).view());
        if (fix.status != Status::ok) continue;
        ++count;
        EXPECT_TRUE(is_right(fix, shot)) << "frame " << i;
        EXPECT_LE(fix.p_wrong_log2, -30);
    }
    return count;
}

/// In nominal frames of this spacing, one bit in 30,000 is misread.
TEST(ErrorRate, AKnownOneMakesSmallViewsCertain) {
    constexpr int kFrames = 100;
    const int unknown = located(0, kFrames);
    EXPECT_LT(unknown, kFrames / 2);
    EXPECT_EQ(located(1, kFrames), unknown) << "one bit in one: nothing is known";
    EXPECT_GE(located(1000, kFrames), kFrames * 85 / 100);
    EXPECT_GE(located(10000, kFrames), kFrames * 88 / 100);
}

}  // namespace
}  // namespace dotpose::core_test::error_rate_test
