// Tests sum_of_near_alternatives against a double-precision sum. For every run of adjacent lines,
// an exhaustive search finds the alternatives whose digits in this run equal those of the reading.
#include "core/integrity/near_alternatives.hpp"

#include <gtest/gtest.h>

#include "code/basis.hpp"
#include "core/kernels/select.hpp"
#include "ratios_case.hpp"

namespace dotpose::core_test::near_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 52;

/// Returns the places p in the sequence `text` for which digits p + run to p + run + digits - 1
/// equal the corresponding digits of the place `own`.
std::vector<std::uint32_t> places_with_digits(const std::string& text, std::uint32_t own, int run,
                                              int digits) {
    const auto digit = [&](std::uint32_t place, int n) {
        return text[(place + static_cast<std::uint32_t>(run + n)) % text.size()];
    };
    std::vector<std::uint32_t> places;
    for (std::uint32_t place = 0; place < text.size(); ++place) {
        bool is_same = true;
        for (int n = 0; n < digits; ++n)
            is_same = is_same && digit(place, n) == digit(own, n);
        if (is_same) places.push_back(place);
    }
    return places;
}

struct ExactSum {
    double sum = 0;
    int alternatives = 0;
};

ExactSum exact_sum(const RatiosCase& c, int shared_lines) {
    const auto texts = code_test::secondary_texts(c.code);
    const PlacesOfAlternative own = own_places(c);
    ExactSum exact;
    for (int run = 0; run + shared_lines <= static_cast<int>(c.rolls.size()); ++run) {
        const auto places = [&](std::size_t k) {
            return places_with_digits(std::string(texts[k]), own[k], run, shared_lines - 1);
        };
        for (const std::uint32_t a : places(0)) {
            for (const std::uint32_t b : places(1)) {
                for (const std::uint32_t d : places(2)) {
                    for (const std::uint32_t e : places(3)) {
                        const PlacesOfAlternative alternative{a, b, d, e};
                        if (alternative == own) continue;
                        exact.sum += odds_of_rolls(
                            c, rolls_from(c, alternative, static_cast<std::size_t>(run)));
                        ++exact.alternatives;
                    }
                }
            }
        }
    }
    return exact;
}

TEST(NearAlternatives, AreSummedOneByOne) {
    Rng rng(kSeed);
    for (int i = 0; i < 12; ++i) {
        const RatiosCase c = read_at_random(rng, 6 + i % 9);
        const LikelihoodRatios ratios = c.ratios();
        for (const int shared_lines : {4, 5}) {
            const double sum = static_cast<double>(
                sum_of_near_alternatives(kernels(), RankedLines(ratios), shared_lines));
            const ExactSum exact = exact_sum(c, shared_lines);
            ASSERT_GT(exact.alternatives, 0);
            EXPECT_GE(sum, 0.97 * exact.sum) << i << ", " << shared_lines << ", seed " << kSeed;
            EXPECT_LE(sum, 1.04 * exact.sum) << i << ", " << shared_lines << ", seed " << kSeed;
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test::near_alternatives_test
