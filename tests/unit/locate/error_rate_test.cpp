// Tests that small views are located if the rate of misread bits is known or measured.
#include "dotpose/error_rate.hpp"

#include <climits>
#include <memory>

#include <gtest/gtest.h>

#include "../../altered_pattern.hpp"
#include "shots.hpp"

namespace dotpose::core_test::error_rate_test {
namespace {

constexpr std::uint64_t kSeed = 4243;

Shot shot_of_small_view(int index) {
    return shot_of({.width_px = 96, .height_px = 96}, kSeed, static_cast<std::uint64_t>(index));
}

/// Returns the number of located frames of 96 x 96 px, from `first` to `end` - 1. Expects all fixes
/// to be correct.
int located(Locator& locator, int first, int end) {
    int count = 0;
    for (int i = first; i < end; ++i) {
        const Shot shot = shot_of_small_view(i);
        const Fix fix = locator.locate(render(shot).view());
        if (fix.status != Status::ok) continue;
        ++count;
        EXPECT_TRUE(is_right(fix, shot)) << "frame " << i;
        EXPECT_LE(fix.p_wrong_log2, -30);
    }
    return count;
}

DeviceOptions with_bits_per_error(int bits_per_error) {
    DeviceOptions options;
    options.integrity.bits_per_error = bits_per_error;
    return options;
}

class SmallViews : public testing::Test {
  protected:
    int located(int bits_per_error, int frames) {
        Locator locator(*memory_, with_bits_per_error(bits_per_error));
        return error_rate_test::located(locator, 0, frames);
    }
    std::unique_ptr<LargeMemory> memory_ = std::make_unique<LargeMemory>();
};

/// In nominal frames of this spacing, one bit in 30,000 is misread.
TEST_F(SmallViews, AreCertainWithAKnownErrorRate) {
    constexpr int kFrames = 100;
    const int unknown = located(0, kFrames);
    EXPECT_LT(unknown, kFrames / 2);
    EXPECT_EQ(located(1, kFrames), unknown) << "one bit in one: nothing is known";
    EXPECT_GE(located(1000, kFrames), kFrames * 85 / 100);
    EXPECT_GE(located(10000, kFrames), kFrames * 88 / 100);
}

TEST_F(SmallViews, AreCertainOnceTheErrorRateIsMeasured) {
    Locator locator(*memory_, with_bits_per_error(kMeasuredErrorRate));
    EXPECT_EQ(locator.error_rate().bits_per_error(), 0);
    error_rate_test::located(locator, 0, 50);
    EXPECT_GT(locator.error_rate().bits_per_error(), 500);
    EXPECT_GE(error_rate_test::located(locator, 50, 150), 88);
    locator.set_options(with_bits_per_error(kMeasuredErrorRate));
    EXPECT_EQ(locator.error_rate().bits_per_error(), 0) << "new options start a new measurement";
}

/// If only the frames with a fix were counted, the error rate would seem lower than it is, because
/// frames with wrong bits are refused more often.
TEST_F(SmallViews, CountIfTheyAreRefused) {
    Locator locator(*memory_, with_bits_per_error(0));
    int refused = 0;
    for (int i = 0; i < 30; ++i) {
        const Fix fix = locator.locate(render(shot_of_small_view(i)).view());
        EXPECT_GT(locator.compared_bits().count, 120) << "frame " << i;
        refused += fix.status == Status::not_certain ? 1 : 0;
    }
    EXPECT_GT(refused, 10);
    const GreyImage white{std::vector<std::uint8_t>(96 * 96, 255), 96, 96};
    EXPECT_NE(locator.locate(white.view()).status, Status::ok);
    EXPECT_EQ(locator.compared_bits().count, 0);
}

TEST_F(SmallViews, GiveALowerLimitOfTheTrueNumber) {
    constexpr int kTrueBitsPerError = 30;
    Locator locator(*memory_, with_bits_per_error(kMeasuredErrorRate));
    for (int i = 0; i < 200; ++i) {
        const Shot shot = shot_of_small_view(i);
        const GreyImage image = test::render_dots(shot, [&](Cell cell) {
            return test::displacement_of(
                test::flipped_symbol(shot.page.pattern, 1.0 / kTrueBitsPerError, shot.seed, cell));
        });
        const Fix fix = locator.locate(image.view());
        EXPECT_TRUE(fix.status != Status::ok || is_right(fix, shot)) << "frame " << i;
    }
    EXPECT_GT(locator.error_rate().bits_per_error(), kTrueBitsPerError / 2);
    EXPECT_LE(locator.error_rate().bits_per_error(), kTrueBitsPerError);
}

TEST_F(SmallViews, AreNotComparedAgainAfterAFailedCall) {
    const GreyImage image = render(shot_of_small_view(0));
    DeviceOptions options;
    Locator locator(*memory_, options);
    EXPECT_EQ(locator.compared_bits().count, 0) << "before the first frame";
    (void)locator.locate(image.view());
    EXPECT_GT(locator.compared_bits().count, 120);
    EXPECT_EQ(locator.locate({nullptr, 96, 96, 96}).status, Status::bad_argument);
    EXPECT_EQ(locator.compared_bits().count, 0);
    (void)locator.locate(image.view());
    EXPECT_EQ(Locator(*memory_, options).compared_bits().count, 0) << "of another locator";
    (void)locator.locate(image.view());
    EXPECT_EQ(locator.begin(1, 96), Status::image_too_small);
    EXPECT_EQ(locator.compared_bits().count, 0);
    (void)locator.locate(image.view());
    options.effort = Effort::device;
    locator.set_options(options);
    (void)locator.locate(image.view());
    EXPECT_EQ(locator.compared_bits().count, 0);
}

/// Adds `frames` frames of 150 bits at different places.
void add_frames(int frames, int wrong_bits, ErrorRate& rate) {
    static std::uint32_t x = 0;
    for (int i = 0; i < frames; ++i)
        rate.add({.cell = {x += 1000, 7}, .count = 150, .wrong = wrong_bits});
}

TEST(ErrorRate, IsAnUpperLimitFromTheCounts) {
    ErrorRate rate;
    EXPECT_EQ(rate.bits_per_error(), 0);
    add_frames(1, 0, rate);
    EXPECT_EQ(rate.bits_per_error(), 0) << "the next frame may show the same dots";
    add_frames(20, 0, rate);
    EXPECT_EQ(rate.bits_per_error(), 20 * 150 / 3);
    add_frames(1, 4, rate);
    EXPECT_EQ(rate.bits_per_error(), 21 * 150 / (4 + 2 * 2 + 3)) << "wrong bits count immediately";
    rate.add({});
    EXPECT_EQ(rate.bits_per_error(), 21 * 150 / (4 + 2 * 2 + 3)) << "nothing was compared";
}

TEST(ErrorRate, CountsAPlaceOnce) {
    ErrorRate rate;
    for (std::uint32_t i = 0; i < 1000; ++i)
        rate.add({.cell = {5000 + i % 10, 410'815'340 + i % 7}, .count = 150, .wrong = 0});
    EXPECT_EQ(rate.bits_per_error(), 0);
    rate.add({.cell = {5003, 2}, .count = 150, .wrong = 1});  // rows of the plane are cyclic
    add_frames(1, 0, rate);
    EXPECT_EQ(rate.bits_per_error(), 150 / (1 + 2 + 3));
}

/// A slow camera moves by less than its view from frame to frame.
TEST(ErrorRate, CountsASlowCameraAtEachPlace) {
    ErrorRate rate;
    for (std::uint32_t i = 0; i < 1000; ++i)
        rate.add({.cell = {5000 + i, 40}, .count = 150, .wrong = 0});
    // Frames closer than sqrt(2 * 150) = 17 cells may show the same dots.
    EXPECT_EQ(rate.bits_per_error(), 999 / 17 * 150 / 3);
}

/// A robot that drives to and fro sees the same dots again.
TEST(ErrorRate, CountsAPlaceOnceIfTheCameraReturnsToIt) {
    ErrorRate rate;
    constexpr std::uint32_t kPlaces = 32;
    static_assert(kPlaces == ErrorRate::kPlaces);
    for (std::uint32_t i = 0; i < 1000; ++i)
        rate.add({.cell = {1000 * (i % kPlaces), 40}, .count = 150, .wrong = 0});
    EXPECT_EQ(rate.bits_per_error(), 31 * 150 / 3);
}

TEST(ErrorRate, IsInTheRangeOfTheOptionForAnyCounts) {
    ErrorRate rate;
    for (std::uint32_t i = 0; i < 100; ++i)
        rate.add({.cell = {100'000 * i, 40}, .count = 1 << 20, .wrong = 0});
    EXPECT_EQ(rate.bits_per_error(), ErrorRate::kMaxBitsPerError);
    const ErrorRate before = rate;
    for (const ComparedBits& impossible :
         {ComparedBits{{}, INT_MAX, 0}, ComparedBits{{}, 150, -1}, ComparedBits{{}, 150, 151}})
        rate.add(impossible);
    EXPECT_EQ(rate.bits_per_error(), before.bits_per_error());
}

TEST(ErrorRate, ForgetsOldFrames) {
    ErrorRate rate;
    add_frames(2000, 5, rate);
    EXPECT_LT(rate.bits_per_error(), 30);
    add_frames(2000, 0, rate);
    EXPECT_GT(rate.bits_per_error(), 2000);
    add_frames(100'000, 0, rate);
    // 32 places are counted beside the 2^15 settled bits.
    EXPECT_LE(rate.bits_per_error(), ((1 << 15) + 32 * 150) / 3);
}

}  // namespace
}  // namespace dotpose::core_test::error_rate_test
