// Tests the expected odds of double alternatives (positions that differ in two sequences) against a
// double-precision sum over all strings of digits in these two sequences.
#include "core/integrity/expected_double_alternatives.hpp"

#include <gtest/gtest.h>

#include "core/kernels/select.hpp"
#include "ratios_case.hpp"

namespace dotpose::core_test::expected_double_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 53;
constexpr std::size_t kLines = 4;
constexpr std::array<int, 4> kBases{3, 3, 2, 3};

using ByAnchors = std::array<double, kMinFound>;

/// For each of the 63 shifts, adds the odds of one alternative, multiplied by `weight`, to sums[n].
/// The roll offsets of the alternative are `offsets` plus the shift, and n is the number of anchors
/// that the alternative shares with the reading. The anchors are the lines with a rank below
/// `anchors`.
void add_alternative(const RatiosCase& c, const RankedLines& lines, int anchors,
                     const std::array<int, kLines>& offsets, double weight, ByAnchors& sums) {
    for (int first = 0; first < 63; ++first) {
        double odds = weight;
        std::size_t shared = 0;
        for (std::size_t line = 0; line < kLines; ++line) {
            const int shift = ((first + offsets[line]) % 63 + 63) % 63;
            const LineScores& scores = c.storage[line].scores;
            const auto own = static_cast<std::size_t>(c.rolls[line]);
            const int lost = scores[own] - scores[(own + static_cast<std::size_t>(shift)) % 63];
            odds *= std::exp2(-lost * c.odds_q8 / 256.0 / 254);
            const bool is_anchor = lines.rank(static_cast<std::uint32_t>(line)) < anchors;
            shared += shift == 0 && is_anchor ? 1 : 0;
        }
        sums[shared] += odds;
    }
}

ByAnchors exact_sums(const RatiosCase& c, const RankedLines& lines, int anchors) {
    const auto texts = code_test::secondary_texts(c.code);
    const PlacesOfAlternative own = own_places(c);
    ByAnchors sums{};
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t l = k + 1; l < 4; ++l) {
            const int digits = kBases[k] * kBases[l];
            const int strings = digits * digits * digits;
            const double weight = static_cast<double>(texts[k].size() * texts[l].size()) *
                                  std::pow(1.03, kLines - 1) / strings;
            for (int string = 0; string < strings; ++string) {
                std::array<int, kLines> offsets{};
                int rest = string;
                for (std::size_t step = 0; step + 1 < kLines; ++step) {
                    offsets[step + 1] = offsets[step];
                    for (const std::size_t n : {k, l}) {
                        const int digit = rest % kBases[n];
                        rest /= kBases[n];
                        const int read = texts[n][(own[n] + step) % texts[n].size()] - '0';
                        offsets[step + 1] += code_test::kWeights[n] * (digit - read);
                    }
                }
                add_alternative(c, lines, anchors, offsets, weight, sums);
            }
        }
    }
    return sums;
}

TEST(ExpectedDoubleAlternatives, AreThoseOfAllDigits) {
    Rng rng(kSeed);
    for (const int anchors : {2, 3, 4}) {
        const RatiosCase c = read_at_random(rng, kLines);
        const LikelihoodRatios ratios = c.ratios();
        const RankedLines lines(ratios);
        const auto fewer = expected_double_alternatives(kernels(), lines, anchors);
        const ByAnchors exact = exact_sums(c, lines, anchors);
        EXPECT_EQ(fewer[0], 0);
        double sum = 0;
        for (std::size_t n = 0; n < exact.size(); ++n) {
            sum += exact[n];
            EXPECT_NEAR(static_cast<double>(fewer[n + 1]) / sum, 1, 0.03)
                << n << " of " << anchors << ", seed " << kSeed;
        }
    }
}

TEST(ExpectedDoubleAlternatives, AreNeverNothing) {
    Rng rng(kSeed);
    RatiosCase c = read_at_random(rng, 64);
    c.odds_q8 = 16 * 256;
    const LikelihoodRatios ratios = c.ratios();
    const auto fewer = expected_double_alternatives(kernels(), RankedLines(ratios), kMaxAnchors);
    EXPECT_GT(fewer[1], 0);
    EXPECT_LT(fewer[kMinFound], 0x1p-45F);
}

}  // namespace
}  // namespace dotpose::core_test::expected_double_alternatives_test
