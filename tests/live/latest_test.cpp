#include "video/opencv/latest.hpp"

#include <thread>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace dotpose::video
