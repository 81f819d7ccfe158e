// Tests the odds of single alternatives (positions that differ in one sequence) against a
// double-precision sum over all of them.
#include "core/integrity/single_alternatives.hpp"

#include <gtest/gtest.h>

#include "core/kernels/select.hpp"
#include "ratios_case.hpp"

namespace dotpose::core_test::single_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 51;

double exact_sum(const RatiosCase& c) {
    const auto texts = code_test::secondary_texts(c.code);
    double sum = 0;
    for (std::size_t k = 0; k < texts.size(); ++k) {
        PlacesOfAlternative places = own_places(c);
        const std::uint32_t own = places[k];
        for (places[k] = 0; places[k] < texts[k].size(); ++places[k]) {
            if (places[k] == own) continue;
            for (std::size_t shared = 0; shared < c.rolls.size(); ++shared) {
                const auto rolls = rolls_from(c, places, shared);
                if (first_shared(c, rolls) == shared) sum += odds_of_rolls(c, rolls);
            }
        }
    }
    return sum;
}

TEST(SingleAlternatives, AreSummedOneByOne) {
    Rng rng(kSeed);
    for (int i = 0; i < 30; ++i) {
        const RatiosCase c = read_at_random(rng, 6 + i % 9);
        const LikelihoodRatios ratios = c.ratios();
        const double sum =
            static_cast<double>(sum_of_single_alternatives(kernels(), RankedLines(ratios)));
        const double exact = exact_sum(c);
        // The computed powers of two are accurate to within 2 %. An alternative with negligible
        // odds is counted as 2^-64 for each line that the alternative shares with the reading.
        EXPECT_GE(sum, 0.97 * exact) << i << ", seed " << kSeed;
        EXPECT_LE(sum, 1.04 * exact + 737 * 15 * 0x1p-64) << i << ", seed " << kSeed;
    }
}

}  // namespace
}  // namespace dotpose::core_test::single_alternatives_test
