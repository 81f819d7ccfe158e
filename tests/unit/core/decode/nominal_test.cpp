// Tests the symbols of a grid at a known place against a second implementation of the code.
#include "core/decode/nominal.hpp"

#include <gtest/gtest.h>

#include "../../code/reference.hpp"
#include "../geometry.hpp"

namespace dotpose::core_test::nominal_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 31;
constexpr std::uint32_t kL = code_test::kL;

/// Returns the place at a position (x, y). If a coordinate is past the end of the code, the place
/// is the equivalent one near the beginning of the code.
Place wrapped(CodeVariant code, std::uint64_t x, std::uint64_t y, Section section) {
    int u = section.u;
    int v = section.v;
    const int roll_there = code_test::reference_roll(code, kL);
    if (x >= kL) {
        u += roll_there;
        v += static_cast<int>(kL % 63);
    }
    if (y >= kL) {
        u += static_cast<int>(kL % 63);
        v += roll_there;
    }
    return {{static_cast<std::uint32_t>(x % kL), static_cast<std::uint32_t>(y % kL)},
            {static_cast<std::uint8_t>(u % 63), static_cast<std::uint8_t>(v % 63)}};
}

/// Checks all symbols of a grid that contains a window of the pattern, rotated by `turn`. The
/// symbol at index `known` of the window is at cell (0, 0).
void check(CodeVariant code, const Place& first, int columns, int rows, QuarterTurn turn,
           FixedVec known) {
    const code_test::Grid expected = code_test::reference_window(code, first, columns, rows);
    const auto cell_of = [&](int x, int y) { return turn.inverse()({x - known.x, y - known.y}); };
    const FixedVec a = cell_of(0, 0);
    const FixedVec b = cell_of(columns - 1, rows - 1);
    Grid grid;
    grid.i0 = std::min(a.x, b.x);
    grid.j0 = std::min(a.y, b.y);
    grid.columns = std::abs(a.x - b.x) + 1;
    grid.rows = std::abs(a.y - b.y) + 1;
    Decoding decoding;
    decoding.pattern_from_grid = turn;
    decoding.place =
        wrapped(code, std::uint64_t{first.cell.x} + static_cast<unsigned>(known.x),
                std::uint64_t{first.cell.y} + static_cast<unsigned>(known.y), first.section);
    const Nominal nominal(grid, code, decoding);
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const FixedVec step = nominal.pattern_step(cell_of(x, y));
            ASSERT_EQ(step, (FixedVec{x - known.x, y - known.y}));
            ASSERT_EQ(nominal.symbol(step), expected.symbols[expected.index(x, y)])
                << x << ", " << y;
        }
    }
}

TEST(Nominal, IsTheCodeAtEveryTurn) {
    Rng rng(kSeed);
    for (int i = 0; i < 120; ++i) {
        SCOPED_TRACE(testing::Message() << "grid " << i << ", seed " << kSeed);
        const int columns = 8 + static_cast<int>(rng.below(40));
        const int rows = 8 + static_cast<int>(rng.below(40));
        const FixedVec known{
            static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(columns))),
            static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(rows)))};
        Place first = random_place(rng);
        first.cell = {first.cell.x / 2, first.cell.y / 2};
        check(code_test::kCodeVariants[static_cast<std::size_t>(i % 3)], first, columns, rows,
              QuarterTurn{i % 4}, known);
    }
}

TEST(Nominal, ContinuesPastBothEndsOfTheCode) {
    Rng rng(kSeed);
    for (int i = 0; i < 120; ++i) {
        SCOPED_TRACE(testing::Message() << "grid " << i << ", seed " << kSeed);
        Place first = random_place(rng);
        // On one axis or both, the code ends inside the grid, before or after `known`.
        if (i % 3 != 0) first.cell.x = kL - 1 - rng.below(29);
        if (i % 3 != 1) first.cell.y = kL - 1 - rng.below(29);
        const FixedVec known{static_cast<std::int32_t>(rng.below(30)),
                             static_cast<std::int32_t>(rng.below(30))};
        check(code_test::kCodeVariants[static_cast<std::size_t>(i % 3)], first, 30, 30,
              QuarterTurn{i / 3 % 4}, known);
    }
}

TEST(Nominal, CellZeroNeedNotBeInTheGrid) {
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "grid " << i << ", seed " << kSeed);
        Place first = random_place(rng);
        // Half of the places are near the end of the code on both axes.
        if (i % 2 == 0) first.cell = {kL - 1 - rng.below(50), kL - 1 - rng.below(50)};
        check(CodeVariant::anoto, first, 20, 12, QuarterTurn{i % 4},
              {20 + static_cast<std::int32_t>(rng.below(100)),
               12 + static_cast<std::int32_t>(rng.below(100))});
    }
}

TEST(Nominal, HoldsForTheLargestGrid) {
    const Place first{{kL - 100, 5}, {62, 62}};
    for (int quarters = 0; quarters < 4; ++quarters) {
        check(CodeVariant::anoto, first, kMaxGridSide, kMaxGridSide, QuarterTurn{quarters},
              {200, 250});
        check(CodeVariant::anoto, first, kMaxGridSide, kMaxGridSide, QuarterTurn{quarters}, {0, 0});
    }
}

}  // namespace
}  // namespace dotpose::core_test::nominal_test
