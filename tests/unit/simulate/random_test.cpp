#include "dotpose/tools/random.hpp"

#include <bitset>
#include <cmath>

#include <gtest/gtest.h>

namespace dotpose {
namespace {

TEST(Random, IsThePublishedSplitmix64) {
    Rng rng(1234567);
    EXPECT_EQ(rng.bits(), 6457827717110365317u);
    EXPECT_EQ(rng.bits(), 3203168211198807973u);
}

TEST(Random, UniformFillsItsRange) {
    Rng rng(1);
    double least = 1;
    double most = 0;
    double sum = 0;
    for (int i = 0; i < 100000; ++i) {
        const double value = rng.uniform();
        least = std::fmin(least, value);
        most = std::fmax(most, value);
        sum += value;
    }
    EXPECT_GE(least, 0);
    EXPECT_LT(most, 1);
    EXPECT_LT(least, 1e-4);
    EXPECT_GT(most, 1 - 1e-4);
    EXPECT_NEAR(sum / 100000, 0.5, 0.004);
    EXPECT_EQ(rng.uniform(3, 3), 3);
}

TEST(Random, BelowTakesEachValueEquallyOften) {
    Rng rng(2);
    int counts[63] = {};
    for (int i = 0; i < 63000; ++i)
        ++counts[rng.below(63)];
    for (const int count : counts)
        EXPECT_NEAR(count, 1000, 150);
    for (int i = 0; i < 1000; ++i)
        EXPECT_LT(rng.below(0xFFFFFFFFu), 0xFFFFFFFFu);
    EXPECT_EQ(rng.below(1), 0u);
}

// random.hpp defines a normally distributed number as the number of ones among 128 random bits plus
// a uniformly distributed number, shifted and scaled. This test recomputes the number from that
// definition.
TEST(Random, NormalCountsOnes) {
    Rng rng(4);
    Rng same(4);
    for (int i = 0; i < 100'000; ++i) {
        const std::bitset<64> first(same.bits());
        const std::bitset<64> second(same.bits());
        const double ones = static_cast<double>(first.count() + second.count());
        const double expected = (ones - 64 + same.uniform() - 0.5) / std::sqrt(32 + 1.0 / 12);
        ASSERT_NEAR(rng.normal(), expected, 1e-12);
    }
}

TEST(Random, NormalHasUnitDeviationAndNormalTails) {
    Rng rng(3);
    constexpr int kDraws = 1'000'000;
    double sum = 0;
    double square = 0;
    int within_1 = 0;
    int beyond_3 = 0;
    for (int i = 0; i < kDraws; ++i) {
        const double value = rng.normal();
        sum += value;
        square += value * value;
        within_1 += std::abs(value) < 1 ? 1 : 0;
        beyond_3 += std::abs(value) > 3 ? 1 : 0;
    }
    EXPECT_NEAR(sum / kDraws, 0, 0.004);
    EXPECT_NEAR(square / kDraws, 1, 0.005);
    EXPECT_NEAR(static_cast<double>(within_1) / kDraws, 0.6827, 0.003);
    EXPECT_NEAR(static_cast<double>(beyond_3) / kDraws, 0.0027, 0.0003);
}

TEST(Random, StreamsOfARunDiffer) {
    EXPECT_NE(Rng(1, 0).bits(), Rng(1, 1).bits());
    EXPECT_NE(Rng(1, 0).bits(), Rng(2, 0).bits());
    EXPECT_EQ(Rng(1, 5).bits(), Rng(1, 5).bits());
}

}  // namespace
}  // namespace dotpose
