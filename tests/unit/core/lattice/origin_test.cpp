// The two conditions of an intact neighbourhood (paper section II-B.2), on tables made by hand.
#include "core/lattice/origin.hpp"

#include <gtest/gtest.h>

#include "../geometry.hpp"

namespace dotpose::core_test {
namespace {

using Table = std::vector<std::array<std::int16_t, 4>>;

/// A block of columns x rows dots, 10 px apart, row by row from (20, 20), each connected to those
/// to its right, left, below and above.
struct Block {
    Block(int columns_, int rows_) : columns(columns_), rows(rows_) {
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                seeds.push_back(static_cast<std::uint16_t>(dots.size()));
                dots.push_back(dot_at({20.0 + 10 * c, 20.0 + 10 * r}));
                neighbours.push_back({at(c + 1, r), at(c - 1, r), at(c, r + 1), at(c, r - 1)});
            }
        }
    }
    std::int16_t at(int c, int r) const {
        const bool is_inside = c >= 0 && r >= 0 && c < columns && r < rows;
        return static_cast<std::int16_t>(is_inside ? r * columns + c : -1);
    }
    /// `from` no longer counts `to`, but `instead`.
    void replace(int from, int to, int instead = -1) {
        for (std::int16_t& n : neighbours[static_cast<std::size_t>(from)]) {
            if (n == to) n = static_cast<std::int16_t>(instead);
        }
    }
    /// Nobody counts this dot any more, and it counts nobody.
    void take_out(int dot) {
        for (auto& of_one : neighbours)
            std::replace(of_one.begin(), of_one.end(), static_cast<std::int16_t>(dot),
                         std::int16_t{-1});
        neighbours[static_cast<std::size_t>(dot)] = {-1, -1, -1, -1};
    }
    Status find(Vec2 centre_px) {
        return core::find_origin(dots, seeds, neighbours, fixed(centre_px, 8), lattice,
                                 origin_seed);
    }

    int columns;
    int rows;
    std::vector<Dot> dots;
    std::vector<std::uint16_t> seeds;
    Table neighbours;
    Lattice lattice;
    int origin_seed = -2;
};

/// 3 x 3 dots:  0 1 2 / 3 4 5 / 6 7 8. Only 4 can be the centre.
Block three_by_three() {
    return {3, 3};
}

TEST(Origin, AnIntactNeighbourhoodIsFound) {
    Block block = three_by_three();
    ASSERT_EQ(block.find({0, 0}), Status::ok);
    EXPECT_EQ(block.origin_seed, 4);
    EXPECT_EQ(block.lattice.origin_q16, fixed({30, 30}, 16));
}

TEST(Origin, IsTheMeanOfTheCentreAndItsSides) {
    Block block = three_by_three();
    block.dots[4] = dot_at({31, 30});
    block.dots[1] = dot_at({30.5, 18});
    block.dots[5] = dot_at({42, 33});
    block.dots[0] = dot_at({15, 15});  // a corner has no say
    ASSERT_EQ(block.find({0, 0}), Status::ok);
    EXPECT_NEAR(real(block.lattice.origin_q16, 16).x, (31 + 30.5 + 42 + 20 + 30) / 5, 1e-3);
    EXPECT_NEAR(real(block.lattice.origin_q16, 16).y, (30 + 18 + 33 + 30 + 40) / 5.0, 1e-3);
}

void expect_none(Block& block) {
    EXPECT_EQ(block.find({30, 30}), Status::no_intact_neighbourhood);
    EXPECT_EQ(block.origin_seed, -1);
}

TEST(Origin, EverySideMustBeConnectedBothWays) {
    for (const int side : {1, 3, 5, 7}) {
        SCOPED_TRACE(side);
        Block forgets_centre = three_by_three();
        forgets_centre.replace(side, 4);
        expect_none(forgets_centre);
        Block is_forgotten = three_by_three();
        is_forgotten.replace(4, side);
        expect_none(is_forgotten);
        Block missing = three_by_three();
        missing.take_out(side);
        expect_none(missing);
    }
}

TEST(Origin, EveryCornerMustBeConnectedToTwoSides) {
    // The sides of each corner.
    const std::vector<std::array<int, 3>> corners{{0, 1, 3}, {2, 1, 5}, {6, 3, 7}, {8, 5, 7}};
    for (const auto& [corner, side, other_side] : corners) {
        SCOPED_TRACE(corner);
        Block missing = three_by_three();
        missing.take_out(corner);
        expect_none(missing);
        for (const auto& [from, to] :
             {std::pair{corner, side}, std::pair{side, corner}, std::pair{corner, other_side},
              std::pair{other_side, corner}}) {
            Block one_way = three_by_three();
            one_way.replace(from, to);
            expect_none(one_way);
        }
    }
}

TEST(Origin, ThereMustBeNoFifthCorner) {
    // One more dot, connected to the sides 1 and 5 in place of what lies beyond them.
    Block block = three_by_three();
    block.dots.push_back(dot_at({45, 15}));
    block.seeds.push_back(9);
    block.neighbours.push_back({1, 5, -1, -1});
    block.replace(1, -1, 9);
    block.replace(5, -1, 9);
    expect_none(block);
}

TEST(Origin, TheNextCandidateIsTakenWhereTheNearestIsNotIntact) {
    Block block(7, 5);
    ASSERT_EQ(block.find({51, 41}), Status::ok);
    EXPECT_EQ(block.origin_seed, block.at(3, 2));
    // Without dot (2, 1) four centres are lost as side or corner; and itself.
    block.take_out(block.at(2, 1));
    ASSERT_EQ(block.find({52, 39}), Status::ok);
    EXPECT_EQ(block.origin_seed, block.at(4, 2));
    ASSERT_EQ(block.find({20, 60}), Status::ok);
    EXPECT_EQ(block.origin_seed, block.at(1, 3));
    EXPECT_EQ(block.lattice.origin_q16, fixed({30, 50}, 16));
}

TEST(Origin, NoDotsNoOrigin) {
    Block block(0, 0);
    expect_none(block);
}

}  // namespace
}  // namespace dotpose::core_test
