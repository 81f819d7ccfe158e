// Checks that decoding inverts encoding for random upright windows, and that turned windows are
// refused unless the code contains them too. The nightly test checks a million windows.
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include "../unit/code/reference.hpp"
#include "dotpose/code.hpp"
#include "gtest/gtest.h"

namespace dotpose::code_test {
namespace {

constexpr std::uint64_t kSeed = 6667695;
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__)
constexpr int kDraws = 200'000;
#else
constexpr int kDraws = 50'000;  // fewer windows, because unoptimized and sanitized builds are slow
#endif
constexpr int kDrawsAtLength = 5 * kDraws;

struct Draw {
    CodeVariant code = CodeVariant::anoto;
    Place place;
    int columns = 6;
    int rows = 6;
    int quarter_turns = 0;
};

std::string describe(const Draw& draw) {
    return code_test::describe(draw.code, draw.place) + " window " + std::to_string(draw.columns) +
           " x " + std::to_string(draw.rows) + " turned " + std::to_string(draw.quarter_turns);
}

/// Returns a random position. One position in 16 is within 40 positions of the end of the axis,
/// where windows wrap.
template <typename Rng>
std::uint32_t random_position(Rng& rng) {
    if (random_int(rng, 0, 15) != 0) return random_place(rng).cell.x;
    return (kL - 40 + static_cast<std::uint32_t>(random_int(rng, 0, 79))) % kL;
}

Draw random_draw(std::uint64_t seed) {
    std::minstd_rand rng(static_cast<std::uint32_t>(seed % 2147483646 + 1));
    rng.discard(3);  // the first numbers generated from consecutive seeds are similar
    Draw draw;
    draw.code = kCodeVariants[static_cast<std::size_t>(random_int(rng, 0, 2))];
    draw.place = random_place(rng);
    draw.place.cell = {random_position(rng), random_position(rng)};
    draw.quarter_turns = random_int(rng, 0, 3);
    // Windows smaller than 8 x 8 can be ambiguous in the `libdots` code. See decode_test.cpp.
    const int smallest = draw.code == CodeVariant::libdots ? 8 : 6;
    const int kind = random_int(rng, 0, 15);
    draw.columns = draw.rows = kind < 8 ? smallest : 8;
    if (kind == 15) {
        draw.columns = random_int(rng, smallest, 32);
        draw.rows = random_int(rng, smallest, 32);
    }
    return draw;
}

Grid encode(const Draw& draw) {
    Grid grid{draw.columns, draw.rows, {}};
    grid.symbols.reserve(static_cast<std::size_t>(draw.columns * draw.rows));
    const auto& [cell, section] = draw.place;
    for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(draw.rows); ++r) {
        for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(draw.columns); ++c) {
            grid.symbols.push_back(symbol_at(draw.code, {cell.x + c, cell.y + r}, section));
        }
    }
    return grid;
}

/// Turns the window by the number of quarter turns in the draw. Checks that `decode` either refuses
/// the turned window, or returns a place at which the code contains it. Returns a description of
/// the failure, or "" if there is none.
std::string check_turned(const Draw& draw, const Grid& upright) {
    Grid seen = upright;
    for (int i = 0; i < draw.quarter_turns; ++i)
        seen = turned(seen);
    if (draw.quarter_turns > 0) {
        Place place;
        const Status status = decode(draw.code, seen.window(), place);
        // Turning reverses and inverts the bits along at least one axis. If a string of 7 bits
        // occurs in the main sequence, its reversed and inverted form does not. A turned window
        // with at least 7 columns and 7 rows must therefore be refused.
        if (draw.columns >= 7 && draw.rows >= 7 && status != Status::not_in_code) {
            return "a turned window was not refused";
        }
        if (status == Status::ok && !shows(draw.code, place, seen)) {
            return "a turned window was located at a place with other symbols";
        }
    }
    for (int i = draw.quarter_turns; i < 4; ++i)
        seen = turned(seen);
    if (seen != upright) return "turning on to a whole turn changed the window";
    return "";
}

/// Checks that the window of a draw equals the reference, and is decoded to the place of the draw.
/// Returns a description of the failure, or "" if there is none.
std::string check(const Draw& draw) {
    const Grid grid = encode(draw);
    if (grid != reference_window(draw.code, draw.place, draw.columns, draw.rows)) {
        return "symbol_at differs from the reference";
    }
    Place place;
    const Status status = decode(draw.code, grid.window(), place);
    if (status != Status::ok) return std::string("refused: ") + name(status);
    if (place != draw.place) return "found at " + code_test::describe(draw.code, place);
    return check_turned(draw, grid);
}

void check_draws(int first, int end) {
    for (int i = first; i < end; ++i) {
        const std::uint64_t seed = kSeed + static_cast<std::uint64_t>(i);
        const Draw draw = random_draw(seed);
        ASSERT_EQ(check(draw), "") << describe(draw) << " seed " << seed;
    }
}

TEST(CodeProperty, RandomWindowsAreFoundAndTurnedOnesRefused) {
    check_draws(0, kDraws);
}

TEST(CodePropertyAtLength, RandomWindowsAreFoundAndTurnedOnesRefused) {
    check_draws(kDraws, kDrawsAtLength);
}

TEST(CodeProperty, TheDrawsReachTheCorners) {
    int across_wrap = 0;
    int large = 0;
    std::array<int, 4> turns{};
    std::array<int, 3> codes{};
    for (std::uint64_t i = 0; i < kDraws; ++i) {
        const Draw draw = random_draw(kSeed + i);
        const std::uint64_t last = draw.place.cell.x + static_cast<std::uint64_t>(draw.columns) - 1;
        across_wrap += last >= kL ? 1 : 0;
        large += draw.columns > 24 && draw.rows > 24 ? 1 : 0;
        ++turns[static_cast<std::size_t>(draw.quarter_turns)];
        ++codes[static_cast<std::size_t>(draw.code)];
    }
    EXPECT_GT(across_wrap, kDraws / 1000);
    EXPECT_GT(large, kDraws / 1000);
    for (const int count : turns)
        EXPECT_GT(count, kDraws / 5);
    for (const int count : codes)
        EXPECT_GT(count, kDraws / 4);
}

TEST(CodeProperty, EverySectionAtAndAcrossTheWrap) {
    int n = 0;
    int section = 0;
    for (int u = 0; u < 63; ++u) {
        for (int v = 0; v < 63; ++v) {
            for (const std::uint32_t x : {0U, kL - 1, kL - 5}) {
                const std::uint32_t y = n % 2 == 0 ? kL - 3 : 0;
                const Draw draw{
                    kCodeVariants[static_cast<std::size_t>(n % 3)],
                    {{x, y}, {static_cast<std::uint8_t>(u), static_cast<std::uint8_t>(v)}},
                    8,
                    8,
                    (n + section) % 4};
                ASSERT_EQ(check(draw), "") << describe(draw);
                ++n;
            }
            ++n;        // so that each x occurs with every code variant
            ++section;  // so that each x occurs with every turn
        }
    }
}

TEST(CodeProperty, EveryPositionOfOneSheet) {
    for (std::uint32_t x = 0; x < 400; ++x) {
        for (std::uint32_t y = 0; y < 3; ++y) {
            for (const CodeVariant code : kCodeVariants) {
                const Draw draw{code, {{x, y}, {10, 2}}, 8, 8, static_cast<int>(x % 4)};
                ASSERT_EQ(check(draw), "") << describe(draw);
            }
        }
    }
}

TEST(CodeProperty, TurningASymbolTurnsItsDisplacement) {
    // A quarter turn of the page is clockwise: up becomes right, right becomes down, and so on.
    EXPECT_EQ(turned(Symbol::up), Symbol::right);
    EXPECT_EQ(turned(Symbol::right), Symbol::down);
    EXPECT_EQ(turned(Symbol::down), Symbol::left);
    EXPECT_EQ(turned(Symbol::left), Symbol::up);
    for (const auto& [symbol, displacement] : kDisplacements) {
        EXPECT_EQ(dx(turned(symbol)), -displacement.down);
        EXPECT_EQ(dy(turned(symbol)), displacement.right);
    }
}

}  // namespace
}  // namespace dotpose::code_test
