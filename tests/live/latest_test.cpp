#include "video/latest.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "video/frame_source.hpp"

namespace dotpose::video {
namespace {

using namespace std::chrono_literals;

TEST(Latest, GivesTheNewestAndCountsTheOthers) {
    Latest<int> latest;
    EXPECT_FALSE(latest.take(1ms).has_value());
    for (int i = 0; i < 5; ++i)
        latest.put(i);
    EXPECT_EQ(latest.take(1ms), 4);
    EXPECT_EQ(latest.dropped(), 4);
    EXPECT_FALSE(latest.take(1ms).has_value());
    latest.put(9);
    EXPECT_EQ(latest.take(1ms), 9);
    EXPECT_EQ(latest.dropped(), 4);
}

TEST(Latest, LosesNothingBetweenThreadsButWhatItCounts) {
    constexpr int kValues = 20'000;
    Latest<int> latest;
    std::thread producer([&] {
        for (int i = 1; i <= kValues; ++i)
            latest.put(i);
    });
    int taken = 0;
    int last = 0;
    while (last < kValues) {
        const auto value = latest.take(100ms);
        if (!value) continue;
        EXPECT_GT(*value, last);
        last = *value;
        ++taken;
    }
    producer.join();
    EXPECT_EQ(taken + latest.dropped(), kValues);
}

TEST(Cropped, IsThePartAsked) {
    GreyImage image{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, 4, 3};
    const GreyImage part = cropped(image, {1, 1, 2, 2});
    EXPECT_EQ(part.width_px, 2);
    EXPECT_EQ(part.height_px, 2);
    EXPECT_EQ(part.pixels, (std::vector<std::uint8_t>{5, 6, 9, 10}));
    EXPECT_EQ(cropped(image, {0, 0, 4, 3}).pixels, image.pixels);
    for (const Region& bad :
         {Region{3, 0, 2, 1}, Region{0, 2, 1, 2}, Region{-1, 0, 1, 1}, Region{0, 0, 0, 1}}) {
        EXPECT_THROW(cropped(image, bad), BadArgument);
    }
}

}  // namespace
}  // namespace dotpose::video
