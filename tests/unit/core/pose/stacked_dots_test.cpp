// Tests the grouping of dot images by sub-pixel phase.
#include "core/pose/stacked_dots.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "dotpose/tools/simulate.hpp"

namespace dotpose::core_test::stacked_dots_test {
namespace {

using core::Phase;
using core::StackedDots;

class Stacks : public testing::Test {
  protected:
    static constexpr float kPaper = 200;

    /// Adds `count` dots with the same phase, at pixels with the grey level 150.
    void add(int count, core::FloatVec rest) {
        for (int i = 0; i < count; ++i)
            stacks_.add(image_.view(), Phase({10 + rest.x, 10 + rest.y}), kPaper);
    }
    std::vector<float> counts() const {
        std::vector<float> counts;
        stacks_.visit([&](const StackedDots::Stack& stack) { counts.push_back(stack.dots); });
        return counts;
    }

    GreyImage image_{std::vector<std::uint8_t>(400, 150), 20, 20};
    StackedDots stacks_{2.5F};
};

TEST_F(Stacks, KeepsTheFullest) {
    add(3, {-0.4F, 0});
    add(1, {-0.1F, 0});
    add(5, {0.1F, 0});
    add(3, {0.4F, 0});
    EXPECT_EQ(counts(), (std::vector<float>{3, 1, 5, 3}));
    stacks_.keep_fullest(2, 100);
    EXPECT_EQ(counts(), (std::vector<float>{3, 5}));
    EXPECT_EQ(stacks_.dots(), 8);
}

TEST_F(Stacks, KeepsNoMoreThanEnoughDots) {
    add(3, {-0.4F, 0});
    add(1, {-0.1F, 0});
    add(5, {0.1F, 0});
    stacks_.keep_fullest(3, 6);
    EXPECT_EQ(counts(), (std::vector<float>{3, 5}));
    stacks_.keep_fullest(3, 5);
    EXPECT_EQ(counts(), (std::vector<float>{5}));
}

TEST_F(Stacks, UsesTheDiscWithinReach) {
    int pixels = 0;
    stacks_.visit_pixels([&](int u, int v) {
        EXPECT_LE(u * u + v * v, 2.5 * 2.5);
        ++pixels;
    });
    EXPECT_EQ(pixels, 21);
}

TEST_F(Stacks, HasTheMassAndNoiseOfEqualDots) {
    add(20, {});
    ASSERT_TRUE(stacks_.are_enough());
    EXPECT_NEAR(stacks_.mass(), 21 * 0.25, 1e-4);
    EXPECT_LT(stacks_.noise_2(), 2e-6);
}

TEST_F(Stacks, HasTheSpreadOfADisc) {
    // The squared distances of the 21 pixels from the central column sum to 34 px^2, and those from
    // a centre 0.5 px away to 34 + 21 / 4 px^2.
    add(20, {0.5F, 0});
    EXPECT_NEAR(stacks_.spread_px2(), (34 + 34 + 21 / 4.0) / (2 * 21), 1e-5);
}

}  // namespace
}  // namespace dotpose::core_test::stacked_dots_test
