// Tests the odds of places in other code variants. Compares these odds with sums over all places
// that differ from the reading only in a4. Also tests that the decoder finds the same places.
#include "core/integrity/weigh_codes.hpp"

#include <gtest/gtest.h>

#include "core/kernels/select.hpp"
#include "ratios_case.hpp"

namespace dotpose::core_test::weigh_codes_test {
namespace {

constexpr std::uint64_t kSeed = 83;

/// Returns a copy of the case in which the lines are treated as lines of the code variant `code`.
RatiosCase as_in(CodeVariant code, const RatiosCase& c) {
    RatiosCase other;
    other.code = code;
    other.position = c.position;
    other.rolls = c.rolls;
    other.storage = c.storage;
    other.odds_q8 = c.odds_q8;
    return other;
}

/// Returns the rolls that the lines would have if the reading were at the same place in the code
/// variant `other`.
std::vector<int> rolls_here(const RatiosCase& c, CodeVariant other) {
    const int further = roll(other, c.position) - roll(c.code, c.position) + kSections;
    std::vector<int> rolls = rolls_from(as_in(other, c), own_places(c), 0);
    for (int& line : rolls)
        line = (line + further) % kSections;
    return rolls;
}

/// Returns the total odds, in double precision, of all places in the other code that differ from
/// the reading only in a4. Includes all shifts, but not the place of the reading itself.
double exact_elsewhere(const RatiosCase& c, CodeVariant other) {
    const RatiosCase theirs = as_in(other, c);
    const std::vector<int> same = rolls_here(c, other);
    double sum = 0;
    for (std::uint32_t place = 0; place < 241; ++place) {
        PlacesOfAlternative places = own_places(c);
        places[3] = place;
        std::vector<int> rolls = rolls_from(theirs, places, 0);
        for (int shift = 0; shift < kSections; ++shift) {
            for (int& line : rolls)
                line = (line + 1) % kSections;
            if (place == own_places(c)[3] && rolls == same) continue;
            sum += odds_of_rolls(c, rolls);
        }
    }
    return sum;
}

TEST(WeighOtherCode, IsTheSumOverAllPlaces) {
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        const RatiosCase c = read_at_random(rng, 8 + i % 9);
        for (const CodeVariant other : code_test::kCodeVariants) {
            if (other == c.code) continue;
            SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
            const OtherAxis axis = weigh_other_code(core::kernels(), c.ratios(), c.code, other);
            const double here = odds_of_rolls(c, rolls_here(c, other));
            EXPECT_NEAR(static_cast<double>(axis.here) / here, 1, 0.03);
            const double exact = exact_elsewhere(c, other);
            EXPECT_GE(static_cast<double>(axis.elsewhere), 0.97 * exact);
            EXPECT_LE(static_cast<double>(axis.elsewhere), 1.03 * exact + 2e-12);
        }
    }
}

TEST(WeighOtherCodes, SumsUpPlacesAlongBothAxes) {
    Rng rng(kSeed + 1);
    int close = 0;
    for (int i = 0; i < 60; ++i) {
        const RatiosCase x = read_at_random(rng, 8 + i % 12);
        RatiosCase y;
        do
            y = read_at_random(rng, 8 + i * 7 % 11);
        while (y.code != x.code);
        const LikelihoodRatios by_x = x.ratios();
        const LikelihoodRatios by_y = y.ratios();
        OtherCodes others;
        weigh_other_codes(core::kernels(), UnsharedLines(by_x), UnsharedLines(by_y), x.code,
                          others);
        EXPECT_EQ(others.first, (Cell{x.position, y.position}));
        for (const CodeVariant other : code_test::kCodeVariants) {
            if (other == x.code) continue;
            SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
            const double x_here = odds_of_rolls(x, rolls_here(x, other));
            const double y_here = odds_of_rolls(y, rolls_here(y, other));
            const double x_elsewhere = exact_elsewhere(x, other);
            const double y_elsewhere = exact_elsewhere(y, other);
            const double exact = x_here * y_elsewhere + x_elsewhere * (y_here + y_elsewhere);
            const OtherCode& there = others.of[static_cast<std::size_t>(other)];
            EXPECT_NEAR(static_cast<double>(there.here()) / (x_here * y_here), 1, 0.06);
            EXPECT_GE(static_cast<double>(there.elsewhere()), 0.94 * exact);
            // The odds of unlikely places are not computed individually. Each unlikely place
            // contributes an upper bound, so the sum may exceed the exact sum.
            const double most = x_here + x_elsewhere + y_here + y_elsewhere;
            EXPECT_LE(static_cast<double>(there.elsewhere()), 1.06 * exact + 2e-12 * most + 4e-13);
            close += exact > 1e-9 ? 1 : 0;
        }
    }
    EXPECT_GT(close, 20);
}

/// Returns `lines` consecutive lines of a code, starting at `position`, each with 12 correct bits
/// of full weight.
RatiosCase clear_lines(CodeVariant code, std::uint32_t position, int lines) {
    Rng rng(kSeed);
    RatiosCase c;
    c.code = code;
    c.position = position;
    c.odds_q8 = 7 * 256;
    int here = 20;
    for (int line = 0; line < lines; ++line) {
        c.rolls.push_back(here);
        c.storage.push_back(scored_line(here, 12, 0, 127, rng));
        here = (here + delta(code, position + static_cast<std::uint32_t>(line))) % kSections;
    }
    return c;
}

TEST(WeighOtherCode, FindsThePlaceThatTheDecoderFinds) {
    constexpr int kLines = 10;
    constexpr std::uint32_t kFirst = 241 * 1000;
    int same = 0;
    int elsewhere = 0;
    for (std::uint32_t position = kFirst; position < kFirst + 241; ++position) {
        for (const CodeVariant read : code_test::kCodeVariants) {
            const RatiosCase c = clear_lines(read, position, kLines);
            std::vector<std::uint8_t> rolls(c.rolls.begin(), c.rolls.end());
            for (const CodeVariant other : code_test::kCodeVariants) {
                if (other == read) continue;
                SCOPED_TRACE(testing::Message() << "position " << position);
                const OtherAxis axis = weigh_other_code(core::kernels(), c.ratios(), read, other);
                std::uint32_t found = 0;
                const Status status = position_from_rolls(other, rolls, found);
                const bool is_elsewhere = status == Status::ok && found != position;
                EXPECT_EQ(axis.best > 0.9F, is_elsewhere) << axis.best;
                if (is_elsewhere) {
                    EXPECT_EQ(axis.position, found);
                }
                const bool is_same = status == Status::ok && found == position &&
                                     roll(other, position) == roll(read, position);
                EXPECT_EQ(axis.here > 0.9F, is_same) << axis.here;
                same += is_same;
                elsewhere += is_elsewhere;
            }
        }
    }
    EXPECT_GT(same, 400);
    EXPECT_GT(elsewhere, 20);
}

}  // namespace
}  // namespace dotpose::core_test::weigh_codes_test
