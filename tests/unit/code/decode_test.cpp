// Tests the decoding of windows. A window of the code must be decoded to its place, and any other
// window must be refused.
#include <array>
#include <cstdint>
#include <random>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dotpose/code.hpp"
#include "gtest/gtest.h"
#include "reference.hpp"
#include "vectors.hpp"

namespace dotpose::code_test::decode_test {
namespace {

constexpr std::uint32_t kSeed = 7998798;

/// Initial value of the output `place`. If a window is refused, `place` must not change.
constexpr Place kUntouched{{1, 2}, {3, 4}};

/// Indices (modulo 241) in the `libdots` sequence a4. The 5-digit string that starts at each of
/// these indices also occurs elsewhere in the sequence.
const std::set<std::uint32_t> kTwinPlaces{82,  238, 170, 236, 177, 237,
                                          195, 217, 198, 218, 199, 219};

Grid grid_of(const CodeVector& vector) {
    Grid grid{8, 8, {}};
    for (const auto& row : vector.rows) {
        for (const char c : row)
            grid.symbols.push_back(symbol_of_letter(c));
    }
    return grid;
}

TEST(Decode, FindsTheVectors) {
    for (const CodeVector& vector : kCodeVectors) {
        SCOPED_TRACE(describe(vector.code, vector.place));
        Place place;
        ASSERT_EQ(decode(vector.code, grid_of(vector).window(), place), Status::ok);
        EXPECT_EQ(place, vector.place);
    }
}

void expect_run(CodeVariant code, std::span<const std::uint8_t> rolls, std::uint32_t first) {
    for (std::size_t i = 0; i + 6 <= rolls.size(); ++i) {
        std::uint32_t position = 0;
        const bool twin = code == CodeVariant::libdots && first + i == 1134;
        const Status status = position_from_rolls(code, rolls.subspan(i, 6), position);
        EXPECT_EQ(status, twin ? Status::ambiguous : Status::ok) << "window " << i;
        EXPECT_EQ(position, twin ? 0 : first + i) << "window " << i;
    }
}

TEST(Decode, RollsFromRealPaperAreOneStraightRun) {
    expect_run(CodeVariant::anoto, kPaperRollsFrom1117, 1117);
    expect_run(CodeVariant::anoto, kPaperRollsFrom1097, 1097);
}

TEST(Decode, RollsFromRealPaperShowTheMisprint) {
    // Position 1117 + 17 = 1134 = 4 * 241 + 170 is at index 170 of a4. Because of the misprint in
    // a4, the 5 digits starting at this index also occur elsewhere, so this window is ambiguous.
    expect_run(CodeVariant::libdots, kPaperRollsFrom1117, 1117);
    expect_run(CodeVariant::libdots, kPaperRollsFrom1097, 1097);
}

TEST(Decode, RollsFromRealPaperAreNotTheMicrodotsCode) {
    int found = 0;
    for (std::size_t i = 0; i + 12 <= kPaperRollsFrom1117.size(); ++i) {
        std::uint32_t position = 0;
        const auto rolls = std::span(kPaperRollsFrom1117).subspan(i, 12);
        found += position_from_rolls(CodeVariant::microdots, rolls, position) == Status::ok ? 1 : 0;
    }
    EXPECT_EQ(found, 0);
}

TEST(Decode, AllThePaperRollsTogetherGiveTheFirstPosition) {
    for (const CodeVariant code : {CodeVariant::anoto, CodeVariant::libdots}) {
        std::uint32_t position = 0;
        EXPECT_EQ(position_from_rolls(code, kPaperRollsFrom1117, position), Status::ok);
        EXPECT_EQ(position, 1117U);
        EXPECT_EQ(position_from_rolls(code, kPaperRollsFrom1097, position), Status::ok);
        EXPECT_EQ(position, 1097U);
    }
}

TEST(Decode, RefusesRollsThatAreTooFewTooManyOrTooClose) {
    std::array<std::uint8_t, 33> rolls{};
    for (std::size_t i = 0; i < rolls.size(); ++i) {
        rolls[i] = static_cast<std::uint8_t>(reference_roll(CodeVariant::anoto, 1000 + i));
    }
    std::uint32_t position = 77;
    for (const std::size_t count : {0U, 1U, 5U, 33U}) {
        EXPECT_EQ(position_from_rolls(CodeVariant::anoto, std::span(rolls).first(count), position),
                  Status::bad_window);
        EXPECT_EQ(position, 77U);
    }
    for (const int outside : {0, 1, 4, 59, 62}) {  // valid differences are 5 to 58
        auto spoilt = rolls;
        spoilt[4] = static_cast<std::uint8_t>((spoilt[3] + outside) % 63);
        EXPECT_EQ(position_from_rolls(CodeVariant::anoto, std::span(spoilt).first(6), position),
                  Status::not_in_code);
        EXPECT_EQ(position, 77U);
    }
    for (const std::size_t count : {6U, 32U}) {
        EXPECT_EQ(position_from_rolls(CodeVariant::anoto, std::span(rolls).first(count), position),
                  Status::ok);
        EXPECT_EQ(position, 1000U);
    }
}

TEST(Decode, RefusesBadWindows) {
    const std::vector<Symbol> symbols(33 * 33, Symbol::up);
    struct Size {
        int columns, rows;
    };
    for (const Size size : {Size{5, 6}, Size{6, 5}, Size{33, 6}, Size{6, 33}, Size{33, 33},
                            Size{0, 0}, Size{0, 6}, Size{6, 0}, Size{-6, -6}, Size{-6, 6},
                            Size{6, -1}, Size{1 << 30, 8}, Size{65'536, 65'536}}) {
        Place place = kUntouched;
        EXPECT_EQ(decode(CodeVariant::anoto, {symbols, size.columns, size.rows}, place),
                  Status::bad_window)
            << size.columns << " x " << size.rows;
        EXPECT_EQ(place, kUntouched);
    }
}

TEST(Decode, RefusesAWindowWithTooFewSymbols) {
    const Grid grid = reference_window(CodeVariant::anoto, {{10, 20}, {3, 4}}, 7, 9);
    const std::span<const Symbol> all(grid.symbols);
    Place place = kUntouched;
    EXPECT_EQ(decode(CodeVariant::anoto, {all.first(62), 7, 9}, place), Status::bad_window);
    EXPECT_EQ(decode(CodeVariant::anoto, {{}, 7, 9}, place), Status::bad_window);
    EXPECT_EQ(place, kUntouched);
    EXPECT_EQ(decode(CodeVariant::anoto, {all.first(63), 7, 9}, place), Status::ok);
    EXPECT_EQ(place, (Place{{10, 20}, {3, 4}}));
}

TEST(Decode, FindsWindowsThatAreNotSquare) {
    struct Size {
        int columns, rows;
    };
    for (const CodeVariant code : kCodeVariants) {
        for (const Size size : {Size{6, 32}, Size{32, 6}, Size{7, 9}, Size{32, 32}, Size{6, 6}}) {
            // In the `libdots` sequence a4, the 5-digit strings starting at indices 100 and 59 are
            // unique, so no window is ambiguous.
            const Place truth{{241 * 1000 + 100, 241 * 77 + 59}, {5, 60}};
            const Grid grid = reference_window(code, truth, size.columns, size.rows);
            Place place;
            ASSERT_EQ(decode(code, grid.window(), place), Status::ok)
                << size.columns << " x " << size.rows << " " << describe(code, truth);
            EXPECT_EQ(place, truth);
        }
    }
}

/// Returns the indices in the `libdots` sequence a4 at which a window is rejected as ambiguous.
/// Expects that the windows at all other indices are decoded.
std::set<std::uint32_t> ambiguous_places(int columns, int rows, bool along_x) {
    std::set<std::uint32_t> result;
    for (std::uint32_t p = 0; p < 241; ++p) {
        const std::uint32_t far = 241 * 1'234'567 + p;
        const Place truth{along_x ? Cell{far, 100} : Cell{100, far}, {9, 33}};
        const Grid grid = reference_window(CodeVariant::libdots, truth, columns, rows);
        Place place = kUntouched;
        const Status status = decode(CodeVariant::libdots, grid.window(), place);
        if (status == Status::ambiguous) {
            result.insert(p);
            EXPECT_EQ(place, kUntouched) << p;
        } else {
            EXPECT_EQ(status, Status::ok) << p;
            EXPECT_EQ(place, truth) << p;
        }
    }
    return result;
}

TEST(Decode, RefusesPublishedWindowsThatStandTwice) {
    for (const bool along_x : {true, false}) {
        SCOPED_TRACE(along_x);
        EXPECT_EQ(ambiguous_places(6, 6, along_x), kTwinPlaces);
        EXPECT_EQ(ambiguous_places(7, 7, along_x), (std::set<std::uint32_t>{198, 218}));
        EXPECT_TRUE(ambiguous_places(8, 8, along_x).empty());
    }
    // On the x axis, only the number of columns determines which windows are ambiguous.
    EXPECT_EQ(ambiguous_places(6, 32, true), kTwinPlaces);
    EXPECT_TRUE(ambiguous_places(8, 6, true).empty());
}

TEST(Decode, RefusesEveryChangedSymbolIn8x8) {
    // Any two 8-bit strings of the main sequence differ in at least 2 bits, so a single wrong bit
    // is always detected.
    std::mt19937 rng(kSeed);
    for (int n = 0; n < 300; ++n) {
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(n % 3)];
        const Place truth = random_place(rng);
        const Grid grid = reference_window(code, truth, 8, 8);
        for (std::size_t i = 0; i < grid.symbols.size(); ++i) {
            for (int change = 1; change < 4; ++change) {  // flips the x bit, the y bit, or both
                Grid spoilt = grid;
                spoilt.symbols[i] = static_cast<Symbol>(static_cast<int>(grid.symbols[i]) ^ change);
                Place place = kUntouched;
                ASSERT_EQ(decode(code, spoilt.window(), place), Status::not_in_code)
                    << describe(code, truth) << " symbol " << i << " seed " << kSeed;
                ASSERT_EQ(place, kUntouched);
            }
        }
    }
}

TEST(Decode, NeverGuessesFromAChanged6x6) {
    // 6 x 6 windows have no redundancy, so most windows with a changed bit occur elsewhere in the
    // code. For such a window, the decoder must return the place at which it occurs. All other
    // windows must be rejected.
    std::mt19937 rng(kSeed);
    int elsewhere = 0;
    constexpr int kDraws = 20'000;
    for (int n = 0; n < kDraws; ++n) {
        const Place truth = random_place(rng);
        Grid grid = reference_window(CodeVariant::anoto, truth, 6, 6);
        Symbol& symbol = grid.symbols[static_cast<std::size_t>(random_int(rng, 0, 35))];
        symbol = static_cast<Symbol>(static_cast<int>(symbol) ^ random_int(rng, 1, 2));
        Place place = kUntouched;
        const Status status = decode(CodeVariant::anoto, grid.window(), place);
        SCOPED_TRACE(describe(CodeVariant::anoto, truth) + " seed " + std::to_string(kSeed));
        if (status != Status::ok) {
            ASSERT_EQ(status, Status::not_in_code);
            ASSERT_EQ(place, kUntouched);
            continue;
        }
        ASSERT_NE(place, truth);
        ASSERT_TRUE(shows(CodeVariant::anoto, place, grid)) << describe(CodeVariant::anoto, place);
        ++elsewhere;
    }
    // An independent simulation in another language gives 70.6 %. With the number of draws used
    // here, the standard deviation is 0.3 %.
    EXPECT_NEAR(static_cast<double>(elsewhere) / kDraws, 0.706, 0.013);
}

TEST(Decode, NeverGuessesFromRandomSymbols) {
    std::mt19937 rng(kSeed);
    constexpr int kDraws = 100'000;
    int found = 0;
    for (int n = 0; n < kDraws; ++n) {
        Grid grid{6, 6, std::vector<Symbol>(36)};
        for (Symbol& symbol : grid.symbols)
            symbol = static_cast<Symbol>(random_int(rng, 0, 3));
        Place place = kUntouched;
        const Status status = decode(CodeVariant::anoto, grid.window(), place);
        if (status == Status::ok) {
            ++found;
            ASSERT_TRUE(shows(CodeVariant::anoto, place, grid))
                << describe(CodeVariant::anoto, place) << " draw " << n << " seed " << kSeed;
        } else {
            ASSERT_EQ(status, Status::not_in_code) << "draw " << n << " seed " << kSeed;
            ASSERT_EQ(place, kUntouched);
        }
    }
    // kPositionsPerAxis * 63 of the 2^36 patterns of an axis are in the code, and the axes are
    // independent. The probability that a random window is in the code is therefore (410815348 * 63
    // / 2^36)^2 = 0.14184. The standard deviation for these draws is 0.0011.
    EXPECT_NEAR(static_cast<double>(found) / kDraws, 0.14184, 5 * 0.0011);
}

TEST(Decode, RefusesRandom8x8) {
    // Only 2^34.6 of the 2^64 possible patterns of an axis are in the code, so a random window is
    // practically never in the code.
    std::mt19937 rng(kSeed);
    for (int n = 0; n < 20'000; ++n) {
        Grid grid{8, 8, std::vector<Symbol>(64)};
        for (Symbol& symbol : grid.symbols)
            symbol = static_cast<Symbol>(random_int(rng, 0, 3));
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(n % 3)];
        Place place = kUntouched;
        ASSERT_EQ(decode(code, grid.window(), place), Status::not_in_code) << "seed " << kSeed;
        ASSERT_EQ(place, kUntouched);
    }
}

TEST(Decode, RefusesOneSymbolAllOver) {
    for (const Symbol symbol : {Symbol::up, Symbol::left, Symbol::right, Symbol::down}) {
        const std::vector<Symbol> symbols(64, symbol);
        Place place = kUntouched;
        EXPECT_EQ(decode(CodeVariant::anoto, {symbols, 8, 8}, place), Status::not_in_code);
        EXPECT_EQ(place, kUntouched);
    }
}

/// Returns a window that extends across the border between two sections. In the columns from `cut`
/// onwards, the section is (`other_u`, `place.section.v`).
Grid across_sections(const Place& place, std::uint8_t other_u, int columns, int cut) {
    Grid seam = reference_window(CodeVariant::anoto, place, columns, 8);
    const Place other{place.cell, {other_u, place.section.v}};
    const Grid there = reference_window(CodeVariant::anoto, other, columns, 8);
    for (int r = 0; r < 8; ++r) {
        for (int c = cut; c < columns; ++c) {
            seam.symbols[seam.index(c, r)] = there.symbols[seam.index(c, r)];
        }
    }
    return seam;
}

TEST(Decode, RefusesElevenColumnsAcrossTwoSections) {
    // Eleven columns have ten differences between adjacent rolls. The difference across the border
    // between the sections is wrong. At least five of the correct differences are on one side of
    // the border, and determine a position. The wrong difference contradicts this position.
    std::mt19937 rng(kSeed);
    int found_in_8 = 0;
    constexpr int kDraws = 20'000;
    for (int n = 0; n < kDraws; ++n) {
        const Place truth = random_place(rng);
        const auto other =
            static_cast<std::uint8_t>((truth.section.u + random_int(rng, 1, 62)) % 63);
        SCOPED_TRACE(describe(CodeVariant::anoto, truth) + " seed " + std::to_string(kSeed));
        Place place = kUntouched;
        const Grid eleven = across_sections(truth, other, 11, random_int(rng, 1, 10));
        ASSERT_EQ(decode(CodeVariant::anoto, eleven.window(), place), Status::not_in_code);
        ASSERT_EQ(place, kUntouched);
        const Grid eight = across_sections(truth, other, 8, random_int(rng, 1, 7));
        if (decode(CodeVariant::anoto, eight.window(), place) != Status::ok) continue;
        ASSERT_TRUE(shows(CodeVariant::anoto, place, eight)) << describe(CodeVariant::anoto, place);
        ++found_in_8;
    }
    // According to an independent simulation in another language (400,000 draws), 0.75 % of the
    // windows with eight columns occur elsewhere in the code. The standard deviation of the
    // fraction measured here is 0.06 %.
    EXPECT_NEAR(static_cast<double>(found_in_8) / kDraws, 0.0075, 0.0025);
}

// If a window is decoded with the wrong code variant, the result may be a wrong place. The expected
// numbers of windows were computed from the sequences by a program in another language.
TEST(Decode, AnotherVariantReadsSomeWindowsWrong) {
    using Pair = std::pair<CodeVariant, CodeVariant>;
    for (const auto& [printed, read] : {Pair{CodeVariant::anoto, CodeVariant::libdots},
                                        Pair{CodeVariant::libdots, CodeVariant::anoto}}) {
        SCOPED_TRACE(static_cast<int>(read));
        int right = 0;
        int wrong = 0;
        for (std::uint32_t p = 0; p < 241; ++p) {
            const Place truth{{241 * 4321 + p, 100}, {7, 8}};
            const Grid grid = reference_window(printed, truth, 8, 8);
            Place place = kUntouched;
            if (decode(read, grid.window(), place) != Status::ok) continue;
            EXPECT_TRUE(shows(read, place, grid)) << p;
            ++(place == truth ? right : wrong);
        }
        EXPECT_EQ(right, 217);
        EXPECT_EQ(wrong, 14);
    }
}

}  // namespace
}  // namespace dotpose::code_test::decode_test
