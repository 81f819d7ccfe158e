// Tests that a cell is read if and only if all its pixels are in the image.
#include "device/read_dots.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "device/near_dot.hpp"
#include "device/predicted.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::read_dots_test {
namespace {

using namespace core;

TEST(ReadDots, LooksAtAllCellsInView) {
    Rng rng(4);
    for (int round = 0; round < 500; ++round) {
        std::array<TrackedRow, kMaxComparedLines> rows{};
        Tracking tracking;
        tracking.grid_rows = rows;
        tracking.width_px = 188;
        tracking.height_px = 120;
        tracking.stride_px = 188;
        tracking.first_cell = 2;
        tracking.last_cell = 29;
        const double angle = round < 4 ? round * std::numbers::pi / 2
                                       : rng.uniform(-std::numbers::pi, std::numbers::pi);
        const double spacing_px = rng.uniform(8.6, 13);
        const double along = spacing_px * 65536 * std::cos(angle);
        const double across = spacing_px * 65536 * std::sin(angle);
        const auto rounded = [](double value) {
            return static_cast<std::int32_t>(std::lround(value));
        };
        tracking.cells.along_x_q16 = {rounded(along), rounded(across)};
        tracking.cells.along_y_q16 = {rounded(-across), rounded(along)};
        const double i_middle = rng.uniform(16, 17);
        const double j_middle = rng.uniform(16, 17);
        tracking.cells.origin_q16 = {rounded(93.5 * 65536 - i_middle * along + j_middle * across),
                                     rounded(59.5 * 65536 - i_middle * across - j_middle * along)};
        set_displacement(4096 / 6, tracking);
        ASSERT_TRUE(begin_reading(tracking));

        std::set<std::pair<int, int>> looked_at;
        const FixedVec x = tracking.cells.along_x_q16;
        const int way = x.y < 0 ? -1 : 1;
        for (int j = 0; j < kMaxComparedLines; ++j) {
            const TrackedRow& row = rows[static_cast<std::size_t>(j)];
            if (row.next_q16.y == TrackedRow::kNever_q16) continue;
            const FixedVec first_q16 = place_q16(tracking.cells, row.i, j);
            EXPECT_EQ(row.next_q16.x, first_q16.x);
            EXPECT_EQ(row.next_q16.y, first_q16.y);
            for (int i = row.i; tracking.view.has(place_q16(tracking.cells, i, j)); i += way)
                looked_at.emplace(i, j);
        }
        for (int j = 0; j < kMaxComparedLines; ++j) {
            for (int i = 0; i < kMaxComparedLines; ++i) {
                const FixedVec at_q16 = place_q16(tracking.cells, i, j);
                // A cell is read only if the square of 7 x 7 px around its intersection is inside
                // the image.
                const auto is_in = [](double at_px, int side_px) {
                    const double pixel = std::floor(at_px);
                    return pixel >= 3 && pixel <= side_px - 4;
                };
                const bool is_in_view =
                    is_in(at_q16.x / 65536.0, 188) && is_in(at_q16.y / 65536.0, 120);
                EXPECT_EQ(looked_at.contains({i, j}), is_in_view) << round << ": " << i << ' ' << j;
            }
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test::read_dots_test
