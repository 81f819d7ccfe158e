// Tests the choice of the best 8 x 8 cells (paper, section II-B.5) against an exhaustive search.
#include "core/decode/window.hpp"

#include <gtest/gtest.h>

#include "../geometry.hpp"

namespace dotpose::core_test::window_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 28;

/// Returns the sum of |P^(x) P^(y)| over a region.
int clarity(const Grid& grid, const GridRegion& region) {
    int sum = 0;
    for (int j = region.j0; j < region.j0 + region.rows; ++j) {
        for (int i = region.i0; i < region.i0 + region.columns; ++i) {
            sum += std::abs(grid.at(i, j).x * grid.at(i, j).y);
        }
    }
    return sum;
}

void resize(Grid& grid, int i0, int j0, int columns, int rows) {
    grid.i0 = i0;
    grid.j0 = j0;
    grid.columns = columns;
    grid.rows = rows;
}

TEST(Window, IsTheClearestOfAll) {
    Rng rng(kSeed);
    OwnedGrid owned(40);
    Grid& grid = owned.grid;
    for (int n = 0; n < 300; ++n) {
        resize(grid, static_cast<int>(rng.below(60)) - 50, static_cast<int>(rng.below(60)) - 50,
               8 + static_cast<int>(rng.below(33)), 8 + static_cast<int>(rng.below(33)));
        for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
            for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
                const auto weight = [&] {
                    return static_cast<std::int8_t>((60 + static_cast<int>(rng.below(68))) *
                                                    (rng.below(2) == 0 ? 1 : -1));
                };
                const bool is_missing = rng.below(10) == 0;
                grid.at(i, j) = is_missing ? GridCell{} : GridCell{weight(), weight(), 1};
            }
        }
        SCOPED_TRACE(testing::Message() << "grid " << n << ", seed " << kSeed);
        const int side = n % 2 == 0 ? 8 : 1 + static_cast<int>(rng.below(40));
        const GridRegion window = choose_window(grid, side);
        ASSERT_EQ(window.columns, std::min(side, grid.columns));
        ASSERT_EQ(window.rows, std::min(side, grid.rows));
        ASSERT_TRUE(grid.contains(window.i0, window.j0));
        ASSERT_TRUE(grid.contains(window.i0 + window.columns - 1, window.j0 + window.rows - 1));
        GridRegion any = window;
        int best = 0;
        for (any.j0 = grid.j0; any.j0 + any.rows <= grid.j0 + grid.rows; ++any.j0) {
            for (any.i0 = grid.i0; any.i0 + any.columns <= grid.i0 + grid.columns; ++any.i0) {
                best = std::max(best, clarity(grid, any));
            }
        }
        ASSERT_EQ(clarity(grid, window), best);
    }
}

TEST(Window, ItsMeanQualityIsThatOfItsCells) {
    OwnedGrid owned(16);
    resize(owned.grid, -3, -3, 8, 8);
    for (int dots = 0; dots <= 64; dots += 16) {
        for (int i = 0; i < 64; ++i) {
            owned.cells[static_cast<std::size_t>(i)] =
                i < dots ? GridCell{127, -127, 1} : GridCell{};
        }
        EXPECT_EQ(mean_quality_q8(owned.grid, {-3, -3, 8, 8}), 4 * dots);
    }
    EXPECT_EQ(mean_quality_q8(owned.grid, choose_window(owned.grid, 8)), 256);
}

}  // namespace
}  // namespace dotpose::core_test::window_test
