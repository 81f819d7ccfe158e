// Tests the rolls of consecutive lines against `roll`, `symbol_at` and the reference
// implementation.
#include "code/rolls.hpp"

#include <gtest/gtest.h>

#include "reference.hpp"

namespace dotpose::code_test::rolls_test {
namespace {

constexpr std::uint32_t kSeed = 50;

std::vector<std::uint8_t> followed(CodeVariant code, std::uint32_t position, int first_roll,
                                   std::size_t count) {
    std::vector<std::uint8_t> rolls(count, 99);
    code::follow_rolls(code, position, first_roll, rolls);
    return rolls;
}

TEST(RollFrom, GivesTheBitsBelowAndBeside) {
    std::mt19937 rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        const Place place = random_place(rng);
        const auto [x, y] = place.cell;
        const int column = code::roll_from(code, x, place.section.u, y);
        const int row = code::roll_from(code, y, place.section.v, x);
        ASSERT_GE(std::min(column, row), 0);
        ASSERT_LT(std::max(column, row), kSections);
        for (std::uint32_t n = 0; n < 63; ++n) {
            const auto bit = [n](int roll) {
                return main_bit(static_cast<std::uint32_t>(roll) + n);
            };
            ASSERT_EQ(bit(column), x_bit(symbol_at(code, {x, y + n}, place.section)))
                << describe(code, place) << ", " << n;
            ASSERT_EQ(bit(row), y_bit(symbol_at(code, {x + n, y}, place.section)))
                << describe(code, place) << ", " << n;
        }
    }
}

TEST(FollowRolls, AreTheRollsOfEachPosition) {
    std::mt19937 rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        const Place place = random_place(rng);
        const std::uint32_t position = place.cell.x / 2;
        const auto rolls = followed(code, position, roll(code, position), 256);
        for (std::size_t line = 0; line < rolls.size(); ++line) {
            const auto at = position + static_cast<std::uint32_t>(line);
            ASSERT_EQ(rolls[line], roll(code, at)) << describe(code, place) << ", " << line;
            if (line % 50 == 0) {
                ASSERT_EQ(rolls[line], reference_roll(code, at));
            }
        }
    }
}

TEST(FollowRolls, AreTheRollsOfEachLineOfASection) {
    std::mt19937 rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        const Place place = random_place(rng);
        const auto [x, y] = place.cell;
        std::vector<std::uint8_t> columns(200, 99);
        code::follow_rolls(code, x / 2, place.section.u, y, columns);
        for (std::uint32_t line = 0; line < columns.size(); ++line) {
            ASSERT_EQ(columns[line], code::roll_from(code, x / 2 + line, place.section.u, y))
                << describe(code, place) << ", " << line;
        }
    }
}

TEST(RollsAhead, AreTheRollsOfEachPosition) {
    std::mt19937 rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        std::uint32_t position = random_place(rng).cell.x / 2;
        const auto added = static_cast<std::uint32_t>(i % kSections);
        code::RollsAhead rolls(code, position);
        for (int moves = 0; moves < 12; ++moves) {
            for (std::uint32_t line = 0; line < 64; line += 7) {
                const auto expected =
                    (static_cast<std::uint32_t>(roll(code, position + line)) + added) % kSections;
                ASSERT_EQ(rolls.at(line, added), expected) << moves << ", " << line;
            }
            rolls.advance();
            position += kSections;
        }
    }
}

TEST(FollowRolls, CountFromTheFirstRollGiven) {
    std::mt19937 rng(kSeed);
    for (int first = 0; first < 63; ++first) {
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(first % 3)];
        const std::uint32_t position = random_place(rng).cell.x;
        int expected = first;
        std::uint64_t at = position;
        for (const std::uint8_t found : followed(code, position, first, 64)) {
            ASSERT_EQ(found, expected) << position << " + " << at - position << ", seed " << kSeed;
            expected = (expected + reference_delta(code, at++)) % 63;
        }
    }
}

TEST(FollowRolls, CarryOverTheEndOfTheCode) {
    // At the end of the code, all sequences restart, but the roll does not return to 0.
    for (const CodeVariant code : kCodeVariants) {
        for (const std::uint32_t before : {1U, 2U, 31U, 200U}) {
            const std::uint32_t position = kL - before;
            const auto rolls = followed(code, position, roll(code, position), 256);
            for (std::size_t line = 0; line < rolls.size(); ++line) {
                ASSERT_EQ(rolls[line], reference_roll(code, std::uint64_t{position} + line))
                    << before << " before the end, line " << line;
            }
        }
    }
}

TEST(FollowRolls, OneLineShowsTheFirstRollAndNoneNothing) {
    EXPECT_EQ(followed(CodeVariant::anoto, 12345, 62, 1), (std::vector<std::uint8_t>{62}));
    EXPECT_TRUE(followed(CodeVariant::anoto, 12345, 62, 0).empty());
}

TEST(RollFurther, IsTheDifferenceOfTheRolls) {
    std::mt19937 rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        const std::uint32_t position = i == 0 ? 0 : i == 1 ? kL - 1 : random_place(rng).cell.x;
        for (const CodeVariant read : kCodeVariants) {
            for (const CodeVariant other : kCodeVariants) {
                const int further =
                    reference_roll(other, position) + 63 - reference_roll(read, position);
                ASSERT_EQ(code::roll_further(read, other, position, position % 241), further % 63)
                    << position << ", seed " << kSeed;
            }
        }
    }
}

}  // namespace
}  // namespace dotpose::code_test::rolls_test
