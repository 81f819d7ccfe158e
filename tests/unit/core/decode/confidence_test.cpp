// Odds of bits, and the bound of the probability that chance agrees.
#include "core/decode/confidence.hpp"

#include <gtest/gtest.h>

#include "chance.hpp"
#include "dotpose/random.hpp"

namespace dotpose::core_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 45;

Confidence confidence(int bits, int weight, int wrong) {
    Confidence result;
    for (int i = 0; i < bits; ++i)
        result.add(i % 2 == 0 ? weight : -weight, i < wrong);
    return result;
}

TEST(OddsPerBit, AreThoseAtWhichTwoMoreAreExpectedWrongThanWere) {
    for (const int bits : {100, 400, 3000}) {
        for (const int wrong : {0, 1, 5, 20}) {
            SCOPED_TRACE(testing::Message() << wrong << " wrong of " << bits);
            // The share of wrong bits is 1 / (1 + odds).
            const double expected = std::log2(bits / (wrong + 2.0) - 1);
            // Weights are known in steps of 8 and the exponential to 2 %: 0.1 of a power of two in
            // all, and 3 % of the exponent for the middle of the heaviest step.
            EXPECT_NEAR(odds_per_bit_q8(confidence(bits, 127, wrong)) / 256.0, expected,
                        0.1 + 0.03 * expected);
        }
    }
}

TEST(OddsPerBit, GrowWithTheWeightOfWhatIsRight) {
    // Weak bits that are right say more about full ones, in proportion.
    const double full = odds_per_bit_q8(confidence(1000, 124, 50));
    const double half = odds_per_bit_q8(confidence(1000, 60, 50));
    EXPECT_GT(half, 1.7 * full);
}

TEST(OddsPerBit, HalfOfTheWeightWrongSaysNothing) {
    // Weights are kept in steps of 8; those in the middle of a step are kept exactly.
    for (const int weight : {20, 60, 124, 127}) {
        EXPECT_EQ(odds_per_bit_q8(confidence(400, weight, 200)), 0) << weight;
        EXPECT_EQ(odds_per_bit_q8(confidence(400, weight, 400)), 0) << weight;
    }
    EXPECT_EQ(odds_per_bit_q8({}), 0);
}

TEST(OddsPerBit, FallWithTheWrongWeight) {
    int before = INT32_MAX;
    for (int wrong = 0; wrong <= 400; ++wrong) {
        const int odds = odds_per_bit_q8(confidence(400, 127, wrong));
        ASSERT_LE(odds, before) << wrong;
        if (wrong < 150) {
            ASSERT_LT(odds, before) << wrong;
        }
        ASSERT_GE(odds, 0);
        before = odds;
    }
}

TEST(Chance, ChanceIsBoundedFromAboveAndNotFarOff) {
    std::vector<int> sizes;
    for (int n = 1; n <= 300; ++n)
        sizes.push_back(n);
    sizes.insert(sizes.end(), {384, 1000, 4096, 16384, 36864});
    for (const int n : sizes) {
        const auto exact = exact_chance_log2(n);
        const int step = std::max(n / 300, 1);
        for (int e = 0; e <= n; e += step) {
            SCOPED_TRACE(testing::Message() << n << " bits, " << e << " errors");
            Confidence bits;
            for (int i = 0; i < n; ++i)
                bits.add(127, i < e);
            const int odds = odds_per_bit_q8(bits);
            const int bound = chance_log2(bits, odds);
            ASSERT_GE(bound, std::min(exact[static_cast<std::size_t>(e)], 37.0L) - 1e-9L);
            if (2 * e > n) continue;
            // Chernoff's bound gives a factor of up to sqrt(8 n p q) away; odds for two errors more
            // than there were, up to (e + 2) log2((e + 2) / e) or so; the rounding 2 and n / 2^6.
            const double slack = 0.5 * std::log2(8.0 * n) + 10 + n / 64.0;
            ASSERT_LE(bound, exact[static_cast<std::size_t>(e)] + slack);
        }
    }
    EXPECT_GE(chance_log2({}, 8 * 256), 36);
}

TEST(Chance, WeakBitsThatContradictSayLittle) {
    // 200 full bits that agree; of 50 weak ones half contradict, which is what says least.
    const auto chance_with_weak = [](int weight) {
        Confidence bits;
        for (int i = 0; i < 200; ++i)
            bits.add(127, false);
        for (int i = 0; i < 50; ++i)
            bits.add(weight, i % 2 == 0);
        return chance_log2(bits, odds_per_bit_q8(bits));
    };
    EXPECT_LT(chance_with_weak(5), chance_with_weak(60) - 20);
    EXPECT_LT(chance_with_weak(60), chance_with_weak(127) - 20);
    // By chance alone: 200 fair coins.
    EXPECT_GE(chance_with_weak(5), 37 - 200);
}

TEST(Chance, ChanceHoldsForRandomBits) {
    // How often do random bits of random weights agree as well as 2^-k claims, with one hypothesis?
    Rng rng(kSeed);
    constexpr int kTrials = 200'000;
    int beyond = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        Confidence bits;
        for (int i = 0; i < 20; ++i)
            bits.add(static_cast<int>(rng.below(128)), rng.below(2) == 0);
        // Eight bits below 37 hypotheses' worth: 2^-8, so at most 781 of the trials.
        beyond += chance_log2(bits, odds_per_bit_q8(bits)) <= 37 - 8;
    }
    EXPECT_LE(beyond, kTrials / 256 + 100);
    EXPECT_GT(beyond, 0) << "the test shows nothing";
}

}  // namespace
}  // namespace dotpose::core_test
