// Tests the quasi-probabilities (paper, equations 7-9) and the matrices P (figure 8).
#include "core/decode/likelihood.hpp"

#include <gtest/gtest.h>

#include "../geometry.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core_test::likelihood_test {
namespace {

using namespace core;

/// Returns f(r) of equation 9. The nominal offset in this equation is one sixth of the spacing.
double f(double r) {
    constexpr double kR0 = 1.0 / 6;
    if (r * r >= 3 * kR0 * kR0) return 0;
    return 3 * r / (2 * kR0) - r * r * r / (2 * kR0 * kR0 * kR0);
}

TEST(Likelihood, QuasiProbabilityIsEquation9) {
    for (int projection = -65536; projection <= 65536; projection += 7) {
        const int found = quasi_probability(projection);
        // `quasi_probability` rounds r / r0 to multiples of 1/256. Between two adjacent multiples,
        // f changes by at most 3/256.
        ASSERT_NEAR(found / 127.0, f(projection / 65536.0), 0.024) << projection;
    }
    EXPECT_EQ(quasi_probability(0), 0);
    EXPECT_GE(quasi_probability(65536 / 6), 126);
    EXPECT_LE(quasi_probability(-65536 / 6), -126);
}

/// A grid with cells of 16 px and intersection (0, 0) at (100, 100).
const Mesh kMesh = square_mesh(16, 0, {100, 100});
const PlaneFromImage kPlane = core::plane_from_lattice(lattice_of(kMesh), fixed({90, 60}, 8));

DetectedDot dot_in(int i, int j, Vec2 offset) {
    return dot_at(kMesh.at(i + offset.x, j + offset.y));
}

/// Returns two dots in opposite corners of a block of `columns` x `rows` cells whose first cell is
/// (i0, j0). The two dots determine the extent of the grid.
std::vector<DetectedDot> corners(int i0, int j0, int columns, int rows) {
    return {dot_in(i0, j0, {0, -1 / 6.0}), dot_in(i0 + columns - 1, j0 + rows - 1, {0, -1 / 6.0})};
}

TEST(Likelihood, EachSymbolHasItsBits) {
    OwnedGrid owned(16);
    auto dots = corners(-4, -4, 9, 9);
    for (const Symbol symbol : {Symbol::up, Symbol::left, Symbol::right, Symbol::down}) {
        dots.push_back(dot_in(static_cast<int>(symbol), 1, {dx(symbol) / 6.0, dy(symbol) / 6.0}));
    }
    ASSERT_EQ(assign_likelihoods(dots, kPlane, owned.grid), Status::ok);
    EXPECT_EQ(owned.grid.i0, -4);
    EXPECT_EQ(owned.grid.j0, -4);
    EXPECT_EQ(owned.grid.columns, 9);
    EXPECT_EQ(owned.grid.rows, 9);
    for (const Symbol symbol : {Symbol::up, Symbol::left, Symbol::right, Symbol::down}) {
        const GridCell& cell = owned.grid.at(static_cast<int>(symbol), 1);
        EXPECT_NEAR(cell.x, x_bit(symbol) == 1 ? 127 : -127, 4) << letter(symbol);
        EXPECT_NEAR(cell.y, y_bit(symbol) == 1 ? 127 : -127, 4) << letter(symbol);
        EXPECT_EQ(cell.dot, 2 + static_cast<int>(symbol));
    }
    EXPECT_EQ(owned.grid.at(0, 0).dot, GridCell::kNoDot);
    EXPECT_EQ(owned.grid.at(0, 0).x, 0);
}

TEST(Likelihood, TheLikelierOfTwoDotsInACellStaysWhateverTheOrder) {
    const DetectedDot good = dot_in(1, 2, {0.16, 0.01});
    const DetectedDot doubtful = dot_in(1, 2, {-0.02, 0.09});
    for (const bool good_first : {true, false}) {
        auto dots = corners(-4, -4, 9, 9);
        dots.push_back(good_first ? good : doubtful);
        dots.push_back(good_first ? doubtful : good);
        OwnedGrid owned(16);
        ASSERT_EQ(assign_likelihoods(dots, kPlane, owned.grid), Status::ok);
        const GridCell& cell = owned.grid.at(1, 2);
        EXPECT_EQ(cell.dot, good_first ? 2 : 3);
        // According to equations 7-8 with y down, the x bit is computed from dy - dx, and the y bit
        // from dy + dx.
        EXPECT_NEAR(cell.x / 127.0, f(0.01 - 0.16), 0.03);
        EXPECT_NEAR(cell.y / 127.0, f(0.01 + 0.16), 0.03);
        EXPECT_EQ(quality(cell), std::abs(cell.x * cell.y));
    }
}

TEST(Likelihood, ADotBetweenIntersectionsSaysNothing) {
    auto dots = corners(-4, -4, 9, 9);
    dots.push_back(dot_in(0, 0, {0.45, 0.1}));
    OwnedGrid owned(16);
    ASSERT_EQ(assign_likelihoods(dots, kPlane, owned.grid), Status::ok);
    EXPECT_EQ(quality(owned.grid.at(0, 0)), 0);
}

TEST(Likelihood, TheMiddleOfALargerGridIsKept) {
    OwnedGrid owned(16);
    auto dots = corners(-30, -5, 61, 12);
    dots.push_back(dot_in(3, 2, {0, 1 / 6.0}));
    ASSERT_EQ(assign_likelihoods(dots, kPlane, owned.grid), Status::ok);
    EXPECT_EQ(owned.grid.columns, 16);
    EXPECT_EQ(owned.grid.rows, 12);
    EXPECT_EQ(owned.grid.j0, -5);
    EXPECT_EQ(owned.grid.i0, -8);
    EXPECT_EQ(owned.grid.at(3, 2).dot, 2);
    // On one side of the origin, the dots cover more cells than the grid can hold. The grid must
    // keep the cells nearest to the origin.
    ASSERT_EQ(assign_likelihoods(corners(2, -5, 40, 12), kPlane, owned.grid), Status::ok);
    EXPECT_EQ(owned.grid.i0, 2);
    ASSERT_EQ(assign_likelihoods(corners(-45, -5, 40, 12), kPlane, owned.grid), Status::ok);
    EXPECT_EQ(owned.grid.i0, -21);
    EXPECT_EQ(owned.grid.columns, 16);
}

TEST(Likelihood, PerspectiveAndLensAreUndone) {
    PlaneFromImage bent = kPlane;
    bent.perspective_q30 = {1 << 19, -(1 << 18)};
    bent.lens_q40 = 3 << 20;
    std::vector<DetectedDot> dots;
    for (int j = -4; j <= 4; ++j) {
        for (int i = -4; i <= 4; ++i) {
            const Vec2 on_plane{i + 1 / 6.0, static_cast<double>(j)};
            const FixedVec centre_q8 = core::image_point_q8(bent, fixed(on_plane, 16));
            dots.push_back({centre_q8, 500, 9});
        }
    }
    OwnedGrid owned(16);
    ASSERT_EQ(assign_likelihoods(dots, bent, owned.grid), Status::ok);
    ASSERT_EQ(owned.grid.columns, 9);
    for (int j = -4; j <= 4; ++j) {
        for (int i = -4; i <= 4; ++i) {
            // A dot displaced to the right has x bit 0 and y bit 1.
            EXPECT_NEAR(owned.grid.at(i, j).x, -127, 4) << i << ", " << j;
            EXPECT_NEAR(owned.grid.at(i, j).y, 127, 4) << i << ", " << j;
        }
    }
}

TEST(Likelihood, EightByEightCellsAreTheLeast) {
    OwnedGrid owned(16);
    EXPECT_EQ(assign_likelihoods(corners(0, 0, 8, 8), kPlane, owned.grid), Status::ok);
    EXPECT_EQ(assign_likelihoods(corners(0, 0, 7, 8), kPlane, owned.grid), Status::grid_too_small);
    EXPECT_EQ(assign_likelihoods(corners(0, 0, 8, 7), kPlane, owned.grid), Status::grid_too_small);
    EXPECT_EQ(assign_likelihoods({}, kPlane, owned.grid), Status::grid_too_small);
}

}  // namespace
}  // namespace dotpose::core_test::likelihood_test
