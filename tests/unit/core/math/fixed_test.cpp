// Tests integer arithmetic against <cmath> in double and long double precision.
#include "core/math/fixed.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../geometry.hpp"

namespace dotpose::core_test::fixed_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 20;
constexpr double kBamPerRad = 2147483648.0 / std::numbers::pi;

/// Returns the difference a - b along the shorter arc, as a binary angle. `a` is a binary angle,
/// and `b_rad` is in radians.
double bam_difference(std::int32_t a, double b_rad) {
    return std::remainder(a - b_rad * kBamPerRad, 4294967296.0);
}

TEST(Fixed, TheLargerComponentCountsWhateverItsSign) {
    for (const int s : {-1, 1}) {
        for (const int t : {-1, 1}) {
            EXPECT_EQ(larger_component({s * 3, t * 7}), 7);
            EXPECT_EQ(larger_component({s * 7, t * 3}), 7);
        }
    }
    EXPECT_EQ(larger_component({}), 0);
    EXPECT_EQ(magnitude(INT64_MIN + 1), INT64_MAX);
    EXPECT_EQ(magnitude(-5), 5);
}

TEST(Fixed, QuotientsAreRoundedToNearestHalvesAwayFromZero) {
    EXPECT_EQ(divide_rounded(5, 2), 3);
    EXPECT_EQ(divide_rounded(-5, 2), -3);
    EXPECT_EQ(divide_rounded(1, 3), 0);
    EXPECT_EQ(divide_rounded(-2, 3), -1);
    EXPECT_EQ(divide_rounded(0, 7), 0);
    Rng rng(kSeed);
    for (int i = 0; i < 100000; ++i) {
        const auto n = static_cast<std::int64_t>(rng.bits()) >> (24 + rng.below(40));
        const std::int64_t d = 1 + rng.below(1U << (1 + rng.below(20)));
        // In long double, the quotient is precise enough to be rounded correctly.
        const auto expected =
            std::llround(static_cast<long double>(n) / static_cast<long double>(d));
        ASSERT_EQ(divide_rounded(n, d), expected) << n << " / " << d << ", seed " << kSeed;
    }
}

TEST(Fixed, ShiftsAreRoundedToNearestHalvesUp) {
    EXPECT_EQ(shift_rounded(3, 1), 2);
    EXPECT_EQ(shift_rounded(-3, 1), -1);
    EXPECT_EQ(shift_rounded(-5, 2), -1);
    Rng rng(kSeed);
    for (int i = 0; i < 100000; ++i) {
        const int bits = 1 + static_cast<int>(rng.below(32));
        const auto n = static_cast<std::int64_t>(rng.bits()) >> (34 - bits + 1);
        const long double quotient = std::ldexp(static_cast<long double>(n), -bits);
        ASSERT_EQ(shift_rounded(n, bits), std::llround(std::floor(quotient + 0.5L)))
            << n << " >> " << bits << ", seed " << kSeed;
    }
}

TEST(Fixed, ShortQuotientsAreThoseOfTheProcessor) {
    EXPECT_EQ(short_quotient(0, 1), 0);
    EXPECT_EQ(short_quotient(1, INT64_MAX), 0);
    EXPECT_EQ(short_quotient(INT64_MAX, INT64_MAX), 1);
    EXPECT_EQ(short_quotient(INT32_MAX, 1), INT32_MAX);
    EXPECT_EQ(short_quotient(-INT32_MAX, 1), -INT32_MAX);
    Rng rng(kSeed);
    for (int i = 0; i < 20000; ++i) {
        const auto n = static_cast<std::int64_t>(rng.bits()) >> rng.below(63);
        const auto d = static_cast<std::int64_t>(rng.bits() >> 1 >> rng.below(63)) + 1;
        if (magnitude(n / d) > INT32_MAX) continue;
        ASSERT_EQ(short_quotient(n, d), n / d) << n << " / " << d << ", seed " << kSeed;
    }
}

TEST(Fixed, SquareRootIsTheLargestWhoseSquareFits) {
    std::vector<std::uint64_t> numbers{
        0, 1, 2, 3, 4, UINT64_MAX, UINT64_MAX - 1, std::uint64_t{1} << 62, std::uint64_t{1} << 63};
    Rng rng(kSeed);
    for (int i = 0; i < 20000; ++i) {
        numbers.push_back(rng.bits() >> rng.below(64));
        const std::uint64_t root = rng.bits() >> 32;
        numbers.insert(numbers.end(), {root * root, root * root - 1, root * root + 1});
    }
    numbers.push_back(std::uint64_t{UINT32_MAX} * UINT32_MAX);
    for (const std::uint64_t n : numbers) {
        const std::uint64_t root = square_root(n);
        ASSERT_LE(root * root, n);
        // This condition is equivalent to (root + 1)^2 > n, but does not overflow.
        ASSERT_GE(root * root + 2 * root, n) << "seed " << kSeed;
        const auto narrow = static_cast<std::uint32_t>(n);
        ASSERT_EQ(square_root(narrow), square_root(std::uint64_t{narrow})) << "seed " << kSeed;
    }
}

/// Compares the median and the upper quartile with the values at these ranks in a sorted list.
void expect_ranks(const std::vector<std::int32_t>& values) {
    std::vector<std::int32_t> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::int32_t> copy = values;
    EXPECT_EQ(median(copy), sorted[(sorted.size() - 1) / 2]);
    copy = values;
    EXPECT_EQ(upper_quartile(copy), sorted[(sorted.size() - 1) * 3 / 4]);
}

TEST(Fixed, MedianAndQuartileAreThoseOfTheSorted) {
    Rng rng(kSeed);
    for (int i = 0; i < 3000 && !HasFailure(); ++i) {
        SCOPED_TRACE("list " + std::to_string(i) + ", seed " + std::to_string(kSeed));
        std::vector<std::int32_t> values(1 + rng.below(300));
        // The ranges of the values vary, from a few repeated values to all 32-bit values.
        const std::uint32_t most = UINT32_MAX >> rng.below(32);
        for (std::int32_t& value : values)
            value = static_cast<std::int32_t>((rng.below(UINT32_MAX) & most) - 2);
        expect_ranks(values);
    }
}

TEST(Fixed, MedianKnowsTheLeastAndTheLargestNumber) {
    for (const std::vector<std::int32_t>& values :
         {std::vector{INT32_MIN, INT32_MAX}, std::vector{INT32_MAX, INT32_MAX, INT32_MIN},
          std::vector{INT32_MIN, INT32_MIN, INT32_MAX}, std::vector{INT32_MAX}}) {
        expect_ranks(values);
    }
    std::vector<std::int32_t> none;
    EXPECT_EQ(median(none), 0);
}

TEST(Fixed, LogarithmsAreRoundedDown) {
    std::vector<std::uint32_t> numbers{1, 2, 3, UINT32_MAX, 1U << 31, (1U << 31) - 1};
    Rng rng(kSeed);
    for (int i = 0; i < 20000; ++i) {
        numbers.push_back(1 + static_cast<std::uint32_t>(rng.bits() >> (33 + rng.below(31))));
    }
    for (const std::uint32_t n : numbers) {
        const double exact = std::log2(n) * 65536;
        ASSERT_LE(static_cast<double>(log2_q16(n)), exact + 1e-6) << n << ", seed " << kSeed;
        ASSERT_GE(static_cast<double>(log2_q16(n)), exact - 1.1) << n << ", seed " << kSeed;
    }
}

TEST(Fixed, SumsOfPowersOfTwoAreRoundedUp) {
    for (int a = -40 * 256; a <= 0; a += 37) {
        for (int b = -40 * 256; b <= 0; b += 41) {
            const double exact = 256 * std::log2(std::exp2(a / 256.0) + std::exp2(b / 256.0));
            ASSERT_GE(add_log2(a, b), exact) << a << ", " << b;
            // The function approximates log2(1 + 2^-d) by chords and rounds twice. The chords are
            // at most 0.021 (5.5 / 256) above the curve.
            ASSERT_LE(add_log2(a, b), exact + 5.5 + 2) << a << ", " << b;
        }
        ASSERT_LE(add_log2(a, kNever_q8), a + 1);
    }
}

TEST(Fixed, ProductsOfVectorsDoNotOverflow) {
    constexpr FixedVec kFar{INT32_MAX, INT32_MIN};
    EXPECT_EQ(dot(kFar, {1, -1}), std::int64_t{INT32_MAX} - INT32_MIN);
    EXPECT_EQ(cross({1 << 30, 0}, {0, 1 << 30}), std::int64_t{1} << 60);
    EXPECT_EQ(cross({0, 1}, {1, 0}), -1);  // positive from +x towards +y
    EXPECT_EQ(squared({3, -4}), 25);
}

TEST(Fixed, AnglesAreThoseOfAtan2) {
    constexpr double kTolerance = 2e-9 * 4294967296.0;
    EXPECT_EQ(angle_bam({0, 0}), 0);
    std::vector<FixedVec> directions{{1, 0},
                                     {0, 1},
                                     {0, -1},
                                     {-1, 0},
                                     {1, 1},
                                     {-1, -1},
                                     {-1, 1},
                                     {(1 << 29) - 1, 1},
                                     {-(1 << 29) + 1, -1},
                                     {1, (1 << 29) - 1},
                                     {-(1 << 29) + 1, (1 << 29) - 1},
                                     {-1, 1 << 20},
                                     {-(1 << 20), -1}};
    Rng rng(kSeed);
    for (int i = 0; i < 200000; ++i) {
        const std::uint32_t range = 2U << rng.below(29);
        directions.push_back({static_cast<std::int32_t>(rng.below(range) - range / 2),
                              static_cast<std::int32_t>(rng.below(range) - range / 2)});
    }
    for (const FixedVec d : directions) {
        if (d == FixedVec{}) continue;
        const double expected = std::atan2(d.y, d.x);
        ASSERT_NEAR(bam_difference(angle_bam(d), expected), 0, kTolerance)
            << d.x << ", " << d.y << ", seed " << kSeed;
    }
}

TEST(Fixed, RoughSinesAreWithinSixPercent) {
    for (int phase = -70000; phase <= 140000; phase += 13) {
        const double turns = 2 * std::numbers::pi * phase / 65536;
        ASSERT_NEAR(std::ldexp(rough_sine(phase), -14), std::sin(turns), 0.06) << phase;
        ASSERT_NEAR(std::ldexp(rough_cosine(phase), -14), std::cos(turns), 0.06) << phase;
    }
}

TEST(Fixed, UnitVectorsAreCosineAndSine) {
    std::vector<std::int32_t> angles{
        0,         1,         -1,      1 << 30,   -(1 << 30), (1 << 30) + 1, -(1 << 30) - 1,
        INT32_MIN, INT32_MAX, 1 << 29, -(1 << 29)};
    Rng rng(kSeed);
    for (int i = 0; i < 200000; ++i)
        angles.push_back(static_cast<std::int32_t>(rng.bits() >> 32));
    for (const std::int32_t angle : angles) {
        const Vec2 unit = real(unit_q30(angle), 30);
        ASSERT_NEAR(unit.x, std::cos(angle / kBamPerRad), 3e-8) << angle << ", seed " << kSeed;
        ASSERT_NEAR(unit.y, std::sin(angle / kBamPerRad), 3e-8) << angle << ", seed " << kSeed;
    }
}

}  // namespace
}  // namespace dotpose::core_test::fixed_test
