// The quick median against sorting.
#include "core/pose/quick_median.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "dotpose/random.hpp"

namespace dotpose::core_test {
namespace {

using core::quick_median;

constexpr std::uint64_t kSeed = 64;

std::int32_t by_sorting(std::vector<std::int32_t> values) {
    std::sort(values.begin(), values.end());
    return values[(values.size() - 1) / 2];
}

TEST(QuickMedian, IsTheLowerMiddleOfAnyNumbers) {
    Rng rng(kSeed);
    for (int i = 0; i < 3000; ++i) {
        std::vector<std::int32_t> values(1 + rng.below(300));
        // From a few that repeat to all there are.
        const std::uint32_t most = UINT32_MAX >> rng.below(32);
        for (std::int32_t& value : values)
            value = static_cast<std::int32_t>(rng.below(UINT32_MAX) & most);
        ASSERT_EQ(quick_median(values), by_sorting(values)) << "list " << i << ", seed " << kSeed;
    }
}

TEST(QuickMedian, KnowsTheLeastAndTheLargestNumber) {
    for (const std::vector<std::int32_t>& values :
         {std::vector{INT32_MIN, INT32_MAX}, std::vector{INT32_MAX, INT32_MAX, INT32_MIN},
          std::vector{INT32_MIN, INT32_MIN, INT32_MAX}, std::vector{INT32_MAX}}) {
        EXPECT_EQ(quick_median(values), by_sorting(values));
    }
    EXPECT_EQ(quick_median({}), 0);
}

}  // namespace
}  // namespace dotpose::core_test
