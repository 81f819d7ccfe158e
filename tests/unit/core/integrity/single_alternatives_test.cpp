// Tests the odds of single alternatives (positions that differ in one sequence) against a
// double-precision sum over all of them.
#include "core/integrity/single_alternatives.hpp"

#include <optional>

#include <gtest/gtest.h>

#include "core/kernels/select.hpp"
#include "ratios_case.hpp"

namespace dotpose::core_test::single_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 51;

constexpr std::size_t kPlenty = 10'000'000;

std::optional<float> sum_of(const RatiosCase& c, std::size_t max_work) {
    const LikelihoodRatios ratios = c.ratios();
    WorkLimit work(max_work);
    return sum_of_single_alternatives(kernels(), LossTables(ratios), 0, work);
}

TEST(SingleAlternatives, AreSummedOneByOne) {
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        const RatiosCase c = read_at_random(rng, 8 + i % 30);
        const auto sum = sum_of(c, kPlenty);
        ASSERT_TRUE(sum);
        const double exact = sum_of_singles(c);
        // The computed powers of two are accurate to within 2 %. Places that are not listed count
        // as 2^-51 for each line, and listed places whose odds are at most 2^-43 may count as
        // 2^-43.
        EXPECT_GE(static_cast<double>(*sum), 0.97 * exact) << i << ", seed " << kSeed;
        EXPECT_LE(static_cast<double>(*sum), 1.04 * exact + 741 * 0x1p-43)
            << i << ", seed " << kSeed;
    }
}

TEST(SingleAlternatives, AreNotSummedBeyondTheWorkLimit) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i)
        EXPECT_FALSE(sum_of(read_at_random(rng, 8 + i), 10)) << i << ", seed " << kSeed;
}

TEST(SingleAlternatives, AreNotSummedInSmallImagesIfAllAreSimilar) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        // With such uncertain bits, no alternative can be skipped.
        RatiosCase c = read_at_random(rng, 8 + i);
        c.odds_q8 = 128;
        EXPECT_TRUE(sum_of(c, kPlenty)) << i << ", seed " << kSeed;
        EXPECT_FALSE(sum_of(c, WorkLimit::kOfSmallImage)) << i << ", seed " << kSeed;
    }
}

}  // namespace
}  // namespace dotpose::core_test::single_alternatives_test
