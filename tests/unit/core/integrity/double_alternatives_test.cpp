// Tests the odds of double alternatives (positions that differ in two sequences) against a
// double-precision sum over all of them.
#include "core/integrity/double_alternatives.hpp"

#include <gtest/gtest.h>

#include "../../code/reference.hpp"
#include "core/decode/correlation.hpp"
#include "core/integrity/expected_double_alternatives.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::double_alternatives_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 46;
constexpr int kLines = 9;
constexpr int kOdds_q8 = 3 * 256;
/// Lower bound of the computed sum. Each of the 190,027 pairs of places contributes at least 2^-64
/// at each of the 63 shifts.
constexpr double kFloor = 190'027.0 * 63 * 0x1p-64;

/// Lines that agree with a position. In each line, the roll of the position has the score 1000. The
/// other rolls have random scores from `least` to `least` + 599.
struct Case {
    Case(Rng& rng, int least) : position(rng.below(kPositionsPerAxis)) {
        lines.all = storage;
        std::uint32_t p = position;
        int here = roll(CodeVariant::anoto, p);
        for (int line = 0; line < kLines; ++line) {
            const auto n = static_cast<std::size_t>(line);
            for (std::int16_t& score : storage[n].scores)
                score = static_cast<std::int16_t>(least + static_cast<int>(rng.below(600)));
            storage[n].scores[static_cast<std::size_t>(here)] = 1000;
            storage[n].best = best_score(storage[n].scores);
            here = (here + delta(CodeVariant::anoto, p)) % kSections;
            p = p + 1 == kPositionsPerAxis ? 0 : p + 1;
        }
        reading = {position, static_cast<std::uint8_t>(roll(CodeVariant::anoto, position)), 0, 0};
    }
    std::uint32_t position;
    std::array<ScoredLine, kLines> storage{};
    Lines lines;
    AxisReading reading;
};

/// Returns the sum of the odds of all double alternatives, relative to the position. A double
/// alternative is at another place in two of the sequences. It is counted once for every shift (0
/// to 62) at which at least one of its lines has the same roll as the position.
double exact_sum(const Case& c) {
    const auto texts = code_test::secondary_texts(CodeVariant::anoto);
    const int first_roll = roll(CodeVariant::anoto, c.position);
    double sum = 0;
    std::array<std::array<std::array<int, kLines>, 241>, 4> rolls{};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t length = texts[k].size();
        for (std::size_t place = 0; place < length; ++place) {
            int offset = 0;
            for (int line = 0; line < kLines; ++line) {
                rolls[k][place][static_cast<std::size_t>(line)] = offset;
                offset += code_test::kWeights[k] *
                          (texts[k][(place + static_cast<std::size_t>(line)) % length] -
                           texts[k][(c.position + static_cast<std::size_t>(line)) % length]);
            }
        }
    }
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t l = k + 1; l < 4; ++l) {
            for (std::size_t i = 0; i < texts[k].size(); ++i) {
                if (i == c.position % texts[k].size()) continue;
                for (std::size_t j = 0; j < texts[l].size(); ++j) {
                    if (j == c.position % texts[l].size()) continue;
                    for (int shift = 0; shift < 63; ++shift) {
                        double lost = 0;
                        bool shares = false;
                        int own = first_roll;
                        std::uint32_t p = c.position;
                        for (std::size_t line = 0; line < kLines; ++line) {
                            const int further = rolls[k][i][line] + rolls[l][j][line] + shift;
                            const int other = ((own + further) % 63 + 63) % 63;
                            shares = shares || other == own;
                            lost += 1000 - c.storage[line].scores[static_cast<std::size_t>(other)];
                            own = (own + delta(CodeVariant::anoto, p)) % 63;
                            ++p;
                        }
                        if (shares) sum += std::exp2(-lost * kOdds_q8 / 256 / 254);
                    }
                }
            }
        }
    }
    return sum;
}

TEST(DoubleAlternativesAtLength, AreSummedOneByOne) {
    Rng rng(kSeed);
    // In each line, the roll of the position has the score 1000. The scores of the other rolls are
    // at most `least` + 599, so they can exceed 1000 only if `least` is 420.
    for (const int least : {-600, -200, 420}) {
        const Case c(rng, least);
        const LikelihoodRatios ratios(CodeVariant::anoto, c.lines, c.reading, kOdds_q8);
        EXPECT_EQ(ratios.max_gain() > 0, least == 420);
        const double exact = exact_sum(c);
        ASSERT_GT(exact, 1e-12);
        const RankedLines lines(ratios);
        // With these limits, all pairs of places that share two or more lines with the position are
        // evaluated. The other pairs contribute 32 times their expected odds.
        const float rest = expected_double_alternatives(kernels(), lines, kLines)[2];
        const auto sum =
            static_cast<double>(sum_of_double_alternatives(kernels(), lines, 1, 0, 64 * rest));
        const double ratio = (sum - kFloor - 31 * static_cast<double>(rest)) / exact;
        // The computed powers of two are accurate to 2 %, and their exponents are rounded to
        // multiples of 2^-8.
        EXPECT_GE(ratio, 0.96) << "least " << least << ", seed " << kSeed;
        // Pairs of places that share at most one line with the position contribute their expected
        // odds, so the sum may exceed the exact sum.
        EXPECT_LE(ratio, least == 420 ? 2 : 1.04) << "least " << least << ", seed " << kSeed;
    }
}

TEST(DoubleAlternatives, AreExpectedWhereThatIsNegligible) {
    Rng rng(kSeed);
    const Case c(rng, -200);
    const LikelihoodRatios ratios(CodeVariant::anoto, c.lines, c.reading, kOdds_q8);
    const RankedLines lines(ratios);
    const double exact = exact_sum(c);
    const auto expected = expected_double_alternatives(kernels(), lines, kLines);
    for (int shared = 4; shared <= kMinFound; ++shared) {
        const float negligible = expected[static_cast<std::size_t>(shared)];
        const double sum =
            static_cast<double>(sum_of_double_alternatives(kernels(), lines, 1, negligible, 1));
        const double ratio = (sum - kFloor) / exact;
        EXPECT_GE(ratio, 0.9) << shared << ", seed " << kSeed;
        EXPECT_LE(ratio, 1.5) << shared << ", seed " << kSeed;
    }
}

TEST(DoubleAlternatives, AreNotLookedAtWhereTheExpectationIsTooMuch) {
    Rng rng(kSeed);
    const Case c(rng, -200);
    const LikelihoodRatios ratios(CodeVariant::anoto, c.lines, c.reading, kOdds_q8);
    const RankedLines lines(ratios);
    const auto expected = expected_double_alternatives(kernels(), lines, kLines);
    const double sum =
        static_cast<double>(sum_of_double_alternatives(kernels(), lines, 1, 0, expected[2] / 2));
    EXPECT_NEAR(sum, kFloor, 0.02 * kFloor) << "of which " << expected[2] << " are expected";
    EXPECT_LT(sum, 0.9 * (exact_sum(c) + kFloor));
}

}  // namespace
}  // namespace dotpose::core_test::double_alternatives_test
