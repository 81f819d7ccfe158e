// Tests symbols and rolls against test vectors, a direct count of the digits, and the reference
// implementation.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <set>
#include <string>

#include "dotpose/code.hpp"
#include "gtest/gtest.h"
#include "reference.hpp"
#include "vectors.hpp"

namespace dotpose::code_test::encode_test {
namespace {

constexpr std::uint32_t kSeed = 20130;

/// Returns the roll at position p, which is the sum of all differences before p. Digit i of a
/// sequence occurs ceil((p - i) / length) times before p.
int roll_by_counting(CodeVariant code, std::uint64_t p) {
    const auto texts = secondary_texts(code);
    std::uint64_t sum = 5 * p;
    for (std::size_t n = 0; n < texts.size(); ++n) {
        const std::uint64_t length = texts[n].size();
        for (std::uint64_t i = 0; i < length; ++i) {
            const std::uint64_t times = (p + length - 1 - i) / length;
            sum += static_cast<std::uint64_t>(kWeights[n] * digit_at(texts[n], i)) * times;
        }
    }
    return static_cast<int>(sum % 63);
}

TEST(Encode, GivesTheVectors) {
    for (const CodeVector& vector : kCodeVectors) {
        SCOPED_TRACE(describe(vector.code, vector.place));
        for (std::uint32_t r = 0; r < 8; ++r) {
            std::string row;
            for (std::uint32_t c = 0; c < 8; ++c) {
                const Cell cell{vector.place.cell.x + c, vector.place.cell.y + r};
                row += letter(symbol_at(vector.code, cell, vector.place.section));
            }
            EXPECT_EQ(row, vector.rows[r]) << "row " << r;
        }
    }
}

TEST(Encode, TheReferenceGivesTheVectors) {
    for (const CodeVector& vector : kCodeVectors) {
        SCOPED_TRACE(describe(vector.code, vector.place));
        const Grid grid = reference_window(vector.code, vector.place, 8, 8);
        for (int i = 0; i < 64; ++i) {
            const auto [row, column] = std::div(i, 8);
            EXPECT_EQ(
                grid.symbols[static_cast<std::size_t>(i)],
                symbol_of_letter(
                    vector.rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]));
        }
    }
}

TEST(Encode, DisplacesDotsAsTheTableSays) {
    struct Row {
        int x_bit, y_bit, right, down;
        char letter;
    };
    for (const Row& row : {Row{0, 0, 0, -1, 'u'}, Row{1, 0, -1, 0, 'l'}, Row{0, 1, 1, 0, 'r'},
                           Row{1, 1, 0, 1, 'd'}}) {
        const Symbol symbol = make_symbol(row.x_bit, row.y_bit);
        SCOPED_TRACE(row.letter);
        EXPECT_EQ(symbol, symbol_of_letter(row.letter));
        EXPECT_EQ(letter(symbol), row.letter);
        EXPECT_EQ(x_bit(symbol), row.x_bit);
        EXPECT_EQ(y_bit(symbol), row.y_bit);
        EXPECT_EQ(dx(symbol), row.right);
        EXPECT_EQ(dy(symbol), row.down);
    }
}

TEST(Encode, MainBitsAreCyclic) {
    for (std::uint32_t i = 0; i < 200; ++i)
        EXPECT_EQ(main_bit(i), kMainText[i % 63] - '0') << i;
    // 2^32 - 1 = 63 * 68174084 + 3, and the main sequence starts with six zeros and a one.
    constexpr std::uint32_t kLast = std::numeric_limits<std::uint32_t>::max();
    EXPECT_EQ(main_bit(kLast), 0);
    EXPECT_EQ(main_bit(kLast - 60), 1);  // index 6 of the main sequence
}

TEST(Encode, DeltasStayWithin5To58AndReachBoth) {
    std::mt19937 rng(kSeed);
    for (const CodeVariant code : kCodeVariants) {
        SCOPED_TRACE(describe(code, {}));
        int smallest = 63;
        int largest = 0;
        for (std::uint32_t i = 0; i < 200'000; ++i) {
            const std::uint32_t p = i < 100'000 ? i : random_place(rng).cell.x;
            const int d = delta(code, p);
            ASSERT_EQ(d, reference_delta(code, p)) << "p " << p << " seed " << kSeed;
            smallest = std::min(smallest, d);
            largest = std::max(largest, d);
        }
        EXPECT_EQ(smallest, 5);
        EXPECT_EQ(largest, 58);
    }
}

TEST(Encode, RollIsThePlainSumOfDifferences) {
    for (const CodeVariant code : kCodeVariants) {
        int sum = 0;
        for (std::uint32_t p = 0; p < 100'000; ++p) {
            ASSERT_EQ(roll(code, p), sum) << describe(code, {}) << " p " << p;
            sum = (sum + reference_delta(code, p)) % 63;
        }
    }
}

TEST(Encode, RollAtRandomPositionsIsTheCountedSum) {
    std::mt19937 rng(kSeed);
    for (const CodeVariant code : kCodeVariants) {
        for (int i = 0; i < 20'000; ++i) {
            // About nine out of ten random 32-bit numbers exceed L, the number of positions. `roll`
            // must accept these numbers as well.
            const auto p = static_cast<std::uint32_t>(rng());
            const int expected = roll_by_counting(code, p);
            ASSERT_EQ(roll(code, p), expected) << "p " << p << " seed " << kSeed;
            ASSERT_EQ(reference_roll(code, p), expected) << "p " << p << " seed " << kSeed;
            ASSERT_EQ(roll(code, p % kL), roll_by_counting(code, p % kL)) << "p " << p % kL;
        }
    }
}

TEST(Encode, RollStepsByDeltaAcrossTheWrap) {
    for (const CodeVariant code : kCodeVariants) {
        for (std::uint32_t p = kL - 500; p < kL + 500; ++p) {
            const int step = (roll(code, p + 1) + 63 - roll(code, p)) % 63;
            ASSERT_EQ(step, delta(code, p)) << describe(code, {}) << " p " << p;
            ASSERT_EQ(step, reference_delta(code, p % kL)) << describe(code, {}) << " p " << p;
        }
    }
}

// Over one period of L positions, the roll increases by 5 L plus one term for each sequence a_i:
// its weight w_i, times L / length_i, times its digit sum. Modulo 63, the increase is 52 for the
// sequences of the patent, and 25 for `microdots`, which has a different a4. The increase is also
// 52 for `libdots`: the misprint removes a 1 from a4, but a4 has an additional 1 at its end, so the
// digit sum is the same.
TEST(Encode, ThePatternContinuesPastTheLastPosition) {
    EXPECT_EQ(kPositionsPerAxis, kL);
    EXPECT_EQ(kL, 410'815'348U);
    EXPECT_EQ(kL % 63, 34U);
    std::mt19937 rng(kSeed);
    for (const CodeVariant code : kCodeVariants) {
        const int turn = code == CodeVariant::microdots ? 25 : 52;
        EXPECT_EQ(roll_by_counting(code, kL), turn);
        EXPECT_EQ(roll(code, kL), turn);
        for (int i = 0; i < 2'000; ++i) {
            const Place near = random_place(rng);
            const auto [u, v] = near.section;
            const auto shifted = [](int section, int by) {
                return static_cast<std::uint8_t>((section + by) % 63);
            };
            SCOPED_TRACE(describe(code, near) + " seed " + std::to_string(kSeed));
            ASSERT_EQ(symbol_at(code, {near.cell.x + kL, near.cell.y}, {u, v}),
                      symbol_at(code, near.cell, {shifted(u, turn), shifted(v, 34)}));
            ASSERT_EQ(symbol_at(code, {near.cell.x, near.cell.y + kL}, {u, v}),
                      symbol_at(code, near.cell, {shifted(u, 34), shifted(v, turn)}));
        }
    }
}

TEST(Encode, SymbolsAtRandomCellsAreTheReferences) {
    std::mt19937 rng(kSeed);
    for (int i = 0; i < 100'000; ++i) {
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        const Place place = random_place(rng);
        ASSERT_EQ(symbol_at(code, place.cell, place.section),
                  reference_window(code, place, 1, 1).symbols[0])
            << describe(code, place) << " seed " << kSeed;
    }
}

TEST(Encode, SectionIsWhatIsLeftOfTheRoll) {
    std::mt19937 rng(kSeed);
    for (int i = 0; i < 100'000; ++i) {
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        const auto [cell, section] = random_place(rng);
        const int seen = static_cast<int>(
            (static_cast<std::uint64_t>(reference_roll(code, cell.x)) + section.u + cell.y) % 63);
        ASSERT_EQ(section_of(code, seen, cell.x, cell.y), section.u)
            << describe(code, {cell, section}) << " seed " << kSeed;
    }
}

TEST(Encode, PublishedAndRestoredDifferInFewColumns) {
    std::set<std::uint32_t> differing;
    for (std::uint32_t p = 0; p < 5 * 241; ++p) {
        if (roll(CodeVariant::anoto, p) != roll(CodeVariant::libdots, p)) differing.insert(p % 241);
    }
    EXPECT_EQ(differing, (std::set<std::uint32_t>{222, 223, 224, 225, 227, 228, 230, 231, 233, 234,
                                                  235, 236, 237, 238}));
}

}  // namespace
}  // namespace dotpose::code_test::encode_test
