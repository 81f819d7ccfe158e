// Tests the odds of bits, and the upper bound on the probability of a match by chance.
#include "core/integrity/confidence.hpp"

#include <gtest/gtest.h>

#include "chance.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::confidence_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 45;

Confidence confidence(int bits, int weight, int wrong) {
    Confidence result;
    for (int i = 0; i < bits; ++i)
        result.add(i % 2 == 0 ? weight : -weight, i < wrong);
    return result;
}

TEST(Confidence, KeepsEachWeightInAStepAroundIt) {
    for (int weight = 0; weight <= 127; ++weight) {
        Confidence found;
        found.add(weight, false);
        found.add(-weight, true);
        int bits = 0;
        for (int level = 0; level < Confidence::kLevels; ++level) {
            bits += found.bits(level);
            if (found.bits(level) == 0) continue;
            EXPECT_EQ(found.bits(level), 2) << weight;
            EXPECT_EQ(found.wrong(level), 1) << weight;
            EXPECT_LE(std::abs(Confidence::weight_of(level) - weight), 4) << weight;
        }
        EXPECT_EQ(bits, 2) << weight;
        EXPECT_EQ(found.bits(), 2) << weight;
        EXPECT_EQ(found.wrong(), 1) << weight;
    }
}

TEST(Confidence, OfTwoAxesIsThatOfAllTheirBits) {
    Confidence sum = confidence(30, 100, 3);
    sum.add(confidence(12, 101, 2));
    sum.add(confidence(7, 20, 7));
    EXPECT_EQ(sum.bits(100 / 8), 42);
    EXPECT_EQ(sum.wrong(100 / 8), 5);
    EXPECT_EQ(sum.bits(20 / 8), 7);
    EXPECT_EQ(sum.wrong(20 / 8), 7);
}

TEST(OddsPerBit, AreThoseAtWhichTwoMoreAreExpectedWrongThanWere) {
    for (const int bits : {100, 400, 3000}) {
        for (const int wrong : {0, 1, 5, 20}) {
            SCOPED_TRACE(testing::Message() << wrong << " wrong of " << bits);
            // The fraction of wrong bits is 1 / (1 + odds). As a margin for small samples, the
            // estimate counts two more wrong bits than were observed.
            const double expected = std::log2(bits / (wrong + 2.0) - 1);
            // The tolerance covers two sources of error. Weights are quantised in steps of 8, which
            // changes the largest weights by up to 3 %. The exponential is accurate to 2 %, which
            // changes the result by less than 0.1.
            EXPECT_NEAR(odds_per_bit_q8(confidence(bits, 127, wrong)) / 256.0, expected,
                        0.1 + 0.03 * expected);
        }
    }
}

TEST(OddsPerBit, DivideTheMarginAmongTheBitsOfAllFramesIfTheErrorRateIsKnown) {
    for (const int bits : {60, 140, 400, 3000}) {
        for (const int wrong : {0, 1, 5}) {
            for (const int bits_per_error : {1, 30, 1000, 20000}) {
                SCOPED_TRACE(testing::Message() << wrong << " wrong of " << bits << ", "
                                                << bits_per_error << " bits per error");
                // The earlier frames have 2 (bits_per_error - 1) bits. Bits of this frame that are
                // wrong are not divided.
                const double margin = 2.0 * bits / (bits + 2.0 * (bits_per_error - 1));
                const double expected = std::log2(bits / (wrong + margin) - 1);
                EXPECT_NEAR(odds_per_bit_q8(confidence(bits, 127, wrong), bits_per_error) / 256.0,
                            expected, 0.1 + 0.03 * expected);
            }
        }
    }
}

TEST(OddsPerBit, AreThoseOfAnUnknownErrorRateForOneBitPerError) {
    for (const int bits : {60, 400}) {
        const Confidence read = confidence(bits, 127, 1);
        EXPECT_EQ(odds_per_bit_q8(read, 0), odds_per_bit_q8(read, 1));
        EXPECT_EQ(odds_per_bit_q8(read), odds_per_bit_q8(read, 1));
        EXPECT_GT(odds_per_bit_q8(read, 100), odds_per_bit_q8(read, 1));
        EXPECT_GE(odds_per_bit_q8(read, 65536), odds_per_bit_q8(read, 100));
    }
}

TEST(OddsPerBit, GrowWithTheWeightOfWhatIsRight) {
    // The odds refer to a bit of full weight. If bits of half the weight have the same fraction of
    // errors, log2 of these odds is about twice as large.
    const double full = odds_per_bit_q8(confidence(1000, 124, 50));
    const double half = odds_per_bit_q8(confidence(1000, 60, 50));
    EXPECT_GT(half, 1.7 * full);
}

TEST(OddsPerBit, HalfOfTheWeightWrongSaysNothing) {
    // Weights are quantised in steps of 8. Weights in the middle of a step are exact.
    for (const int weight : {20, 60, 124, 127}) {
        EXPECT_EQ(odds_per_bit_q8(confidence(400, weight, 200)), 0) << weight;
        EXPECT_EQ(odds_per_bit_q8(confidence(400, weight, 400)), 0) << weight;
    }
    EXPECT_EQ(odds_per_bit_q8({}), 0);
}

TEST(OddsPerBit, FallWithTheWrongWeight) {
    const auto odds_of = [](int wrong) { return odds_per_bit_q8(confidence(400, 127, wrong)); };
    for (int wrong = 0; wrong < 400; ++wrong) {
        ASSERT_LE(odds_of(wrong + 1), odds_of(wrong)) << wrong;
        // log2 of the odds is accurate to 2^-5, and decreases by at least 2^-6 per wrong bit in
        // this range.
        if (wrong < 150) {
            ASSERT_LT(odds_of(wrong + 3), odds_of(wrong)) << wrong;
        }
        ASSERT_GE(odds_of(wrong), 0);
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
            // The tolerance has three parts. The Chernoff bound exceeds the exact probability by a
            // factor of up to sqrt(8 n p q). The odds allow for two additional errors, which
            // changes the result by up to about (e + 2) log2((e + 2) / e). Rounding adds 2 and n /
            // 2^6.
            const double slack = 0.5 * std::log2(8.0 * n) + 10 + n / 64.0;
            ASSERT_LE(bound, exact[static_cast<std::size_t>(e)] + slack);
        }
    }
    EXPECT_GE(chance_log2({}, 8 * 256), 36);
}

TEST(Chance, InFineStepsOfThreeTimesAsManyHypothesesIsABoundToo) {
    constexpr int kThree_q8 = 406;
    for (const int n : {20, 70, 170, 400}) {
        const auto exact = exact_chance_log2(n);
        for (int e = 0; 3 * e < n; ++e) {
            SCOPED_TRACE(testing::Message() << n << " bits, " << e << " errors");
            const Confidence bits = confidence(n, 127, e);
            const int odds = odds_per_bit_q8(bits);
            const double fine = chance_log2_q8(bits, odds, kThree_q8) / 256.0;
            ASSERT_GE(fine, exact[static_cast<std::size_t>(e)] + std::log2(3.0L) - 1e-9L);
            ASSERT_LE(fine, chance_log2(bits, odds) + kThree_q8 / 256.0);
            // Without errors, the bound is nearly exact.
            if (e == 0) {
                ASSERT_LE(fine, exact[0] + std::log2(3.0L) + 0.05L);
            }
        }
    }
}

TEST(Chance, EachBitThatAgreesHasItsFactor) {
    // A bit that agrees multiplies the bound by the factor (1 + 2^-y) / 2, where y is log2 of the
    // odds of the bit. The result for 2^20 equal bits, divided by 2^20, is log2 of this factor with
    // an accuracy of 2^-20.
    constexpr int kDoublings = 20;
    for (const int weight : {4, 12, 60, 124}) {
        Confidence bits = confidence(1, weight, 0);
        for (int i = 0; i < kDoublings; ++i)
            bits.add(Confidence(bits));
        for (int odds_q8 = 0; odds_q8 <= 16 * 256; odds_q8 += 7) {
            const double y = odds_q8 / 256.0 * weight / 127;
            const double exact = std::log2(1 + std::exp2(-y)) - 1;
            const double found = std::ldexp(chance_log2(bits, odds_q8) - 37, -kDoublings);
            ASSERT_GE(found, exact - 1e-6) << weight << " at " << odds_q8;
            // `chance_log2` rounds y down to a multiple of 2^-8, which changes log2 of the factor
            // by at most 2^-9. It approximates the curve of this logarithm by chords, which are at
            // most 0.173 / 2^5 above the curve.
            ASSERT_LE(found, exact + 0.002 + 0.0055) << weight << " at " << odds_q8;
        }
    }
}

TEST(Chance, EachBitThatContradictsHasItsFactor) {
    // The factor of a bit that disagrees is 2^y times the factor of a bit that agrees, where y is
    // log2 of the odds of the bit.
    constexpr int kBits = 1 << 12;
    for (const int weight : {12, 60, 124}) {
        const Confidence agree = confidence(kBits, weight, 0);
        const Confidence contradict = confidence(kBits, weight, kBits / 16);
        for (int odds_q8 = 256; odds_q8 <= 4 * 256; odds_q8 += 64) {
            const int before = chance_log2(agree, odds_q8);
            const int after = chance_log2(contradict, odds_q8);
            if (after > 30) continue;  // close to 37, where the bound on the probability is 1
            const double y = odds_q8 / 256.0 * weight / 127;
            // `chance_log2` rounds y to a multiple of 2^-8, and its result to an integer.
            EXPECT_NEAR(after - before, y * kBits / 16, kBits / 16 / 256.0 + 1.01)
                << weight << " at " << odds_q8;
        }
    }
}

TEST(Chance, WeakBitsThatContradictSayLittle) {
    // 200 bits of full weight agree with the position. Half of the 50 weak bits disagree with it,
    // so the weak bits contain no information. The smaller their weight, the less they may increase
    // the chance.
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
    // The probability that 200 fair bits all agree by chance is 2^-200.
    EXPECT_GE(chance_with_weak(5), 37 - 200);
}

TEST(Chance, ChanceHoldsForRandomBits) {
    // Counts the trials in which the bound for one hypothesis is at most 2^-8. Each trial consists
    // of random bits with random weights.
    Rng rng(kSeed);
    constexpr int kTrials = 200'000;
    int beyond = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        Confidence bits;
        for (int i = 0; i < 20; ++i)
            bits.add(static_cast<int>(rng.below(128)), rng.below(2) == 0);
        // The result is 37 plus log2 of the bound for one hypothesis, because there are 2^37
        // hypotheses. A result of 37 - 8 therefore corresponds to a bound of 2^-8. On average, at
        // most 200,000 / 2^8 = 781 trials may have such a bound.
        beyond += chance_log2(bits, odds_per_bit_q8(bits)) <= 37 - 8;
    }
    EXPECT_LE(beyond, kTrials / 256 + 100);
    EXPECT_GT(beyond, 0) << "the test shows nothing";
}

}  // namespace
}  // namespace dotpose::core_test::confidence_test
