// Tests the computation of each point's cell in 32-bit arithmetic against double precision.
#include "core/math/cells.hpp"

#include <gtest/gtest.h>

#include "../planes.hpp"

namespace dotpose::core_test::cells_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 48;

TEST(Cells, PointsAreRoundedToEighthsOfAPixel) {
    Rng rng(kSeed);
    for (const double side : {188.0, 4096.0}) {
        const PlaneFromImage plane = affine_plane(side, 11, 1, rng);
        const Cells cells(plane);
        for (int i = 0; i < 10000; ++i) {
            const FixedVec p_q8 = fixed({rng.uniform(0, side), rng.uniform(0, side)}, 8);
            const Vec2 exact = 8 * (real(p_q8, 8) - real(plane.centre_q8, 8));
            const FixedVec found = cells.from_centre_q3(p_q8);
            ASSERT_LE(std::abs(found.x - exact.x), 0.5) << "seed " << kSeed;
            ASSERT_LE(std::abs(found.y - exact.y), 0.5) << "seed " << kSeed;
        }
    }
}

TEST(Cells, PlanePointsAreThoseOfTheFormula) {
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        const double side = i % 2 == 0 ? 188 : 4096;
        const double spacing = i % 4 < 2 ? rng.uniform(5.7, 6) : rng.uniform(6, 60);
        SCOPED_TRACE(testing::Message()
                     << "plane " << i << " at " << spacing << ", seed " << kSeed);
        const PlaneFromImage plane = affine_plane(side, spacing, 1, rng);
        const Cells cells(plane);
        const auto reach = static_cast<std::int32_t>(4 * side);
        for (int j = 0; j < 200; ++j) {
            // The first four points are the corners.
            const auto coordinate = [&](int corner) {
                if (j < 4) return corner != 0 ? reach : -reach;
                return static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(2 * reach))) -
                       reach;
            };
            const FixedVec p{coordinate(j & 1), coordinate(j & 2)};
            const Vec2 exact = formula(plane, real(plane.centre_q8, 8) + real(p, 3));
            // Slopes are truncated to multiples of 2^-18 per px on each axis, and their sum to a
            // multiple of 2^-16.
            const double tolerance =
                (std::abs(p.x) + std::abs(p.y)) / 8.0 / (1 << 18) + 2.0 / 65536;
            const Vec2 found = real(cells.plane_point_q16(p), 16);
            ASSERT_NEAR(found.x, exact.x, tolerance) << p.x << ", " << p.y;
            ASSERT_NEAR(found.y, exact.y, tolerance) << p.x << ", " << p.y;
            const GridPoint g = cells(p);
            ASSERT_NEAR(g.cell.x + g.offset_q16.x / 65536.0, exact.x, tolerance);
            ASSERT_NEAR(g.cell.y + g.offset_q16.y / 65536.0, exact.y, tolerance);
            for (const std::int32_t offset : {g.offset_q16.x, g.offset_q16.y}) {
                ASSERT_GE(offset, -32768);
                ASSERT_LT(offset, 32768);
            }
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test::cells_test
