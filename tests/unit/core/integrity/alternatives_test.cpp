// Tests the odds of alternatives against sums that are computed in double precision.
#include "core/integrity/alternatives.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#include <gtest/gtest.h>

#include "../../code/reference.hpp"
#include "../geometry.hpp"
#include "code/basis.hpp"
#include "core/kernels/select.hpp"

namespace dotpose::core_test::alternatives_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 42;

/// Returns log2 of the total odds of all alternatives on the x axis. The odds are those of an
/// error-free window with 12 rows.
int alternatives_of_window(CodeVariant code, const Place& place, int columns, int odds_q8) {
    constexpr int kRows = 12;
    OwnedGrid owned(std::max(columns, kRows));
    owned.grid.columns = columns;
    owned.grid.rows = kRows;
    for (int j = 0; j < kRows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const Place at = moved(code, place, i, j);
            const Symbol symbol = symbol_at(code, at.cell, at.section);
            GridCell& cell = owned.grid.at(i, j);
            cell.x = x_bit(symbol) == 1 ? 127 : -127;
            cell.y = y_bit(symbol) == 1 ? 127 : -127;
        }
    }
    std::array<ScoredLine, kMaxLines> storage;
    const Upright upright(owned.grid, {0, 0, columns, kRows}, {});
    const Lines lines = score_lines(upright, Axis::x, storage);
    AxisReading reading;
    reading.position = place.cell.x;
    reading.roll = static_cast<std::uint8_t>(
        (roll(code, place.cell.x) + place.section.u + static_cast<int>(place.cell.y % 63)) % 63);
    // All bits of the first line agree with the main sequence at this roll.
    EXPECT_EQ(lines[0][reading.roll], 127 * kRows);
    return alternatives_log2(kernels(), LikelihoodRatios(code, lines, reading, odds_q8));
}

TEST(Alternatives, AreNotMoreWithMoreColumns) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        const CodeVariant code = code_test::kCodeVariants[static_cast<std::size_t>(i % 3)];
        const Place place = random_place(rng);
        constexpr int kOdds_q8 = 5 * 256;
        int before = 1;
        for (const int columns : {6, 8, 10, 17}) {
            const int log2 = alternatives_of_window(code, place, columns, kOdds_q8);
            ASSERT_LE(log2, before) << columns << " columns, window " << i << ", seed " << kSeed;
            before = log2;
        }
        // The limit of 2^-40 is much larger than the true sum, because small odds are counted as
        // 2^-56. A position that shares only five of 17 lines with the reading differs in twelve
        // lines, by at least two bits each. With odds of 2^-5 per bit, the odds of such a position
        // are at most 2^-120, and there are 2^29 such positions.
        EXPECT_LE(before, -40);
        // Increasing the reliability of the bits must not make the alternatives more probable.
        EXPECT_LE(alternatives_of_window(code, place, 8, 2 * kOdds_q8),
                  alternatives_of_window(code, place, 8, kOdds_q8));
    }
}

TEST(Alternatives, FewLinesExcludeNone) {
    Rng rng(kSeed);
    const Place place = random_place(rng);
    for (int columns = 1; columns <= 5; ++columns) {
        EXPECT_EQ(alternatives_of_window(CodeVariant::anoto, place, columns, 8 * 256), 0)
            << columns;
    }
    EXPECT_LT(alternatives_of_window(CodeVariant::anoto, place, 17, 8 * 256), 0);
}

using Odds = std::array<float, kSections>;

/// Returns the expected sum of the odds of all alternatives that differ from the reading in two or
/// more sequences. The reading consists of two adjacent lines. The first line is at `position`.
/// `first` and `second` are the odds of the two lines at each roll offset. `factor` is the safety
/// factor for the step between the lines.
double two_lines(std::uint32_t position, const Odds& first, const Odds& second, double factor) {
    constexpr std::array<int, 4> kBases{3, 3, 2, 3};
    const auto texts = code_test::secondary_texts(CodeVariant::anoto);
    double total = 0;
    for (unsigned set = 0; set < 16; ++set) {
        double alternatives = 1;
        int sequences = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            if ((set >> k & 1) == 0) continue;
            alternatives *= static_cast<double>(texts[k].size());
            ++sequences;
        }
        if (sequences < 2) continue;
        int cases = 0;
        double sum = 0;
        // `alternative` encodes one digit of each sequence, as a mixed-radix number with the
        // radices 3, 3, 2 and 3.
        for (int alternative = 0; alternative < 54; ++alternative) {
            int difference = 0;
            bool counts = true;
            int rest = alternative;
            for (std::size_t k = 0; k < 4; ++k) {
                const int digit = rest % kBases[k];
                rest /= kBases[k];
                const int own = texts[k][position % texts[k].size()] - '0';
                if ((set >> k & 1) == 0) {
                    counts = counts && digit == 0;
                } else {
                    difference += code_test::kWeights[k] * (digit - own);
                }
            }
            if (!counts) continue;
            ++cases;
            for (int s = 0; s < 63; ++s) {
                sum += static_cast<double>(first[static_cast<std::size_t>(s)]) *
                       static_cast<double>(
                           second[static_cast<std::size_t>((s + difference + 126) % 63)]);
            }
        }
        total += alternatives * factor * sum / cases;
    }
    return total;
}

constexpr double kUnevenness = 1.03;

float sum_of(std::uint32_t position, int max_shared, const std::vector<Odds>& lines) {
    const code::Basis& basis = code::basis(CodeVariant::anoto);
    std::array<std::uint32_t, 4> places;
    for (std::size_t k = 0; k < places.size(); ++k)
        places[k] = basis[k].place_of(position);
    std::vector<OddsByOffset> padded;
    for (const Odds& odds : lines) {
        OddsByOffset& line = padded.emplace_back();
        line.fill(0);
        std::copy(odds.begin(), odds.end(), line.begin());
    }
    float sum = 0;
    for (unsigned different = 0; different < 16; ++different) {
        if (std::popcount(different) < 2) continue;
        sum += kernels().sum_expected_alternatives(basis, places, different, padded, max_shared);
    }
    return sum;
}

TEST(ExpectedAlternatives, OfOneLineAreAllInProportion) {
    Odds odds{};
    odds[0] = 1;
    odds[17] = 0.25F;
    // Expected number of alternatives that differ in two or more sequences: the product of (1 +
    // length) over all sequences, minus 1 for the reading itself, minus the number of alternatives
    // that differ in one sequence.
    const double alternatives = 237.0 * 234 * 32 * 242 - 1 - (236 + 233 + 31 + 241);
    EXPECT_NEAR(static_cast<double>(sum_of(7, 4, {odds})) / (1.25 * alternatives), 1, 1e-5);
}

TEST(ExpectedAlternatives, OfTwoLinesAreThoseOfEveryPairOfDigits) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        Odds first;
        Odds second;
        for (std::size_t s = 0; s < first.size(); ++s) {
            first[s] = static_cast<float>(std::exp2(-rng.uniform(0, 20)));
            second[s] = static_cast<float>(std::exp2(-rng.uniform(0, 20)));
        }
        first[0] = second[0] = 1;
        const std::uint32_t position = random_place(rng).cell.x;
        const double exact = two_lines(position, first, second, kUnevenness);
        for (const int max_shared : {3, 4}) {
            EXPECT_NEAR(static_cast<double>(sum_of(position, max_shared, {first, second})) / exact,
                        1, 1e-4)
                << i << ", seed " << kSeed;
        }
    }
}

TEST(ExpectedAlternatives, EachDifferenceHasItsOwnShare) {
    // Each line has nonzero odds at only one roll offset, so the sum is the expected number of
    // alternatives whose roll offsets in the two lines differ by `to` - `from`.
    for (const int from : {0, 5, 62}) {
        for (int to = 0; to < 63; ++to) {
            Odds first{};
            Odds second{};
            first[static_cast<std::size_t>(from)] = 1;
            second[static_cast<std::size_t>(to)] = 1;
            constexpr std::uint32_t kPosition = 123'456'789;
            const double exact = two_lines(kPosition, first, second, kUnevenness);
            ASSERT_NEAR(static_cast<double>(sum_of(kPosition, 4, {first, second})), exact,
                        1e-4 * exact + 1e-9)
                << from << " to " << to;
        }
    }
}

TEST(ExpectedAlternatives, ThoseThatShareMoreLinesAreLeftToOthers) {
    Odds same{};
    same[0] = 1;
    for (const int max_shared : {3, 4}) {
        std::vector<Odds> lines;
        for (int n = 1; n <= 6; ++n) {
            lines.push_back(same);
            const float sum = sum_of(99, max_shared, lines);
            if (n <= max_shared) {
                EXPECT_GT(sum, 1000) << n << " lines of " << max_shared;
            } else {
                EXPECT_LT(sum, 1e-12F) << n << " lines of " << max_shared;
            }
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test::alternatives_test
