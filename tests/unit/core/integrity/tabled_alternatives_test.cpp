// Tests the upper bounds that are computed from tables. They must not be smaller than the sums over
// all alternatives, which the tests compute in double precision.
#include "core/integrity/tabled_alternatives.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "code/rolls.hpp"
#include "code/unshared_lines.hpp"
#include "core/kernels/select.hpp"
#include "ratios_case.hpp"

namespace dotpose::core_test::tabled_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 83;

/// Returns the sum of the odds of all alternatives that differ in one sequence and share a line
/// with the reading.
double exact_sum(const LikelihoodRatios& ratios, std::size_t sequence) {
    double sum = 0;
    for (std::uint32_t place = 0; place < ratios.basis[sequence].length; ++place) {
        if (place == ratios.places[sequence]) continue;
        RollOffsets offsets;
        set_roll_offsets(ratios, sequence, place, offsets);
        const auto end = offsets.begin() + ratios.count();
        for (auto shared = offsets.begin(); shared != end; ++shared) {
            // All lines that are shared at one shift belong to the same alternative, which must be
            // counted only once.
            if (std::find(offsets.begin(), shared, *shared) != shared) continue;
            int lost = 0;
            for (int line = 0; line < ratios.count(); ++line)
                lost += ratios.loss(line, offsets[static_cast<std::size_t>(line)] - *shared);
            sum += std::exp2(ratios.log2_odds_q8(lost) / 256.0);
        }
    }
    return sum;
}

/// Compares the bound from each table with the exact sum, for every sequence.
class Comparison {
  public:
    void compare(const LikelihoodRatios& ratios) {
        for (std::size_t sequence = 0; sequence < ratios.basis.size(); ++sequence) {
            const double exact = exact_sum(ratios, sequence);
            for (const int max_lines : code::kUnsharedOf) {
                const UnsharedLines unshared(kernels(), ratios, max_lines);
                compare(unshared, sequence, exact);
            }
        }
    }
    int settled() const { return settled_; }
    /// Returns the minimum ratio of a bound to the exact sum.
    double min_factor() const { return min_factor_; }

  private:
    void compare(const UnsharedLines& unshared, std::size_t sequence, double exact) {
        for (const float enough : {0x1p-33F, 1.0F, std::numeric_limits<float>::infinity()}) {
            unsigned left = 1U << sequence;
            const double bound =
                static_cast<double>(tabled_alternatives(kernels(), unshared, enough, left));
            if (left != 0) {
                EXPECT_EQ(bound, 0);
                continue;
            }
            EXPECT_LE(bound, enough);
            EXPECT_GE(bound, exact) << sequence << " by " << unshared.tables();
            if (enough < 1) ++settled_;
            // Smaller sums are not compared, because the bound counts odds below 2^-64 as 2^-64.
            if (exact > 0x1p-50) min_factor_ = std::min(min_factor_, bound / exact);
        }
    }

    int settled_ = 0;
    double min_factor_ = std::numeric_limits<double>::infinity();
};

/// Returns a random position. Depending on `i`, the position is near the end of the code, near the
/// end of a period of a sequence, or anywhere.
std::uint32_t any_position(Rng& rng, int i) {
    const auto before = static_cast<std::uint32_t>(rng.below(20));
    if (i % 8 == 0) return kPositionsPerAxis - 1 - before;
    constexpr std::array<std::uint32_t, 4> kLengths{236, 233, 31, 241};
    const auto anywhere = static_cast<std::uint32_t>(rng.below(kPositionsPerAxis - 250));
    if (i % 8 > 4) return anywhere;
    const std::uint32_t length = kLengths[static_cast<std::size_t>(i % 4)];
    return anywhere - anywhere % length + length - 1 - std::min(before, length - 1);
}

/// Lines of hard bits. Some of the bits are missing or wrong.
struct BitsCase {
    BitsCase(CodeVariant code_, Rng& rng, int i) : code(code_) {
        reading.position = any_position(rng, i);
        reading.roll = static_cast<std::uint8_t>(rng.below(kSections));
        lines.resize(8 + rng.below(20));
        std::vector<std::uint8_t> rolls(lines.size());
        code::follow_rolls(code, reading.position, reading.roll, rolls);
        const std::uint64_t missing = rng.below(3) * rng.below(6);
        const std::uint64_t wrong = rng.below(3);
        for (std::size_t n = 0; n < lines.size(); ++n) {
            lines[n].code = code::kMainWords[rolls[n]];
            if (rng.below(50) < missing) continue;
            lines[n].seen = (~std::uint32_t{0} >> (10 + rng.below(14))) << rng.below(8);
            for (std::uint32_t bit = 1; bit != 0; bit <<= 1) {
                if (rng.below(50) < missing) lines[n].seen &= ~bit;
                if (rng.below(60) < wrong) lines[n].wrong |= lines[n].seen & bit;
            }
        }
        odds_q8 = static_cast<int>(256 * (2 + rng.below(8)));
    }
    LikelihoodRatios ratios() const { return {code, lines, reading, odds_q8}; }

    CodeVariant code;
    AxisReading reading;
    std::vector<ComparedLine> lines;
    int odds_q8;
};

TEST(TabledAlternatives, AreNoLessThanThereAreByBits) {
    Rng rng(kSeed);
    Comparison comparison;
    for (int i = 0; i < 600; ++i) {
        SCOPED_TRACE(testing::Message() << "lines " << i << ", seed " << kSeed);
        const BitsCase c(code_test::kCodeVariants[static_cast<std::size_t>(i % 3)], rng, i);
        comparison.compare(c.ratios());
    }
    EXPECT_GT(comparison.settled(), 1000);
    EXPECT_LT(comparison.min_factor(), 4);
}

TEST(TabledAlternatives, AreNoLessThanThereAreByScores) {
    Rng rng(kSeed);
    Comparison comparison;
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << "lines " << i << ", seed " << kSeed);
        const int lines = 8 + static_cast<int>(rng.below(14));
        RatiosCase c = at_random_place(rng, lines);
        c.odds_q8 = static_cast<int>(256 * (3 + rng.below(6)));
        const double wrong = 0.01 * static_cast<double>(rng.below(4));
        for (const int roll : c.rolls) {
            const int bits = 8 + static_cast<int>(rng.below(14));
            c.storage.push_back(scored_line(roll, bits, wrong, 127, rng));
        }
        comparison.compare(c.ratios());
    }
    EXPECT_GT(comparison.settled(), 500);
    EXPECT_LT(comparison.min_factor(), 4);
}

TEST(TabledAlternatives, AreNotToldOfFewLines) {
    Rng rng(kSeed);
    const RatiosCase c = read_at_random(rng, 9);
    unsigned sequences = 15;
    EXPECT_EQ(tabled_alternatives(kernels(), UnsharedLines(c.ratios()), 1, sequences), 0.0F);
    EXPECT_EQ(sequences, 15U);
}

}  // namespace
}  // namespace dotpose::core_test::tabled_alternatives_test
