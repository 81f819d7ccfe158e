// Tests the mapping of points between image and plane (paper, equations 3-5, with perspective and
// lens) against double precision.
#include "core/math/plane.hpp"

#include <gtest/gtest.h>

#include "../planes.hpp"
#include "dotpose/device_options.hpp"

namespace dotpose::core_test::plane_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 26;

/// Returns the map from the image to the paper, for a camera above the paper. The camera may be
/// tilted and may have a wide-angle lens. Tilt and lens each change the scale by up to 10 % towards
/// the corners.
PlaneFromImage random_plane(Rng& rng, double side_px, bool is_bent) {
    PlaneFromImage plane = affine_plane(side_px, rng.uniform(6, 60), 1.2, rng);
    if (is_bent) {
        plane.perspective_q30 =
            fixed({rng.uniform(-0.1, 0.1) / side_px, rng.uniform(-0.1, 0.1) / side_px}, 30);
        plane.lens_q40 = FixedLens::from_k(rng.uniform(-0.2, 0.2) / (side_px * side_px)).k_q40;
    }
    return plane;
}

TEST(Plane, PointsAreThoseOfTheFormula) {
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << "plane " << i << ", seed " << kSeed);
        const double side = i % 2 == 0 ? 188 : 4096;
        const PlaneFromImage plane = random_plane(rng, side, i % 3 > 0);
        for (int j = 0; j < 100; ++j) {
            const FixedVec p_q8 = fixed({rng.uniform(0, side), rng.uniform(0, side)}, 8);
            const Vec2 expected = formula(plane, real(p_q8, 8));
            const Vec2 found = real(plane_point_q16(plane, p_q8), 16);
            // The divisor is rounded to a multiple of 2^-30, and the products to multiples of 2^-16
            // spacings.
            ASSERT_NEAR(found.x, expected.x, 4e-5);
            ASSERT_NEAR(found.y, expected.y, 4e-5);
            const GridPoint g = grid_point(plane, p_q8);
            ASSERT_EQ(g.cell.x * 65536 + g.offset_q16.x, plane_point_q16(plane, p_q8).x);
            ASSERT_EQ(g.cell.y * 65536 + g.offset_q16.y, plane_point_q16(plane, p_q8).y);
            for (const std::int32_t offset : {g.offset_q16.x, g.offset_q16.y}) {
                ASSERT_GE(offset, -32768);
                ASSERT_LT(offset, 32768);
            }
        }
    }
}

TEST(Plane, OfALatticeGivesItsCoordinates) {
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        Mesh mesh = square_mesh(rng.uniform(6, 60), rng.uniform(0, 6.3),
                                {rng.uniform(0, 4095), rng.uniform(0, 4095)});
        mesh.v = rng.uniform(0.8, 1.25) * mesh.v + rng.uniform(-0.2, 0.2) * mesh.u;
        const PlaneFromImage plane =
            plane_from_lattice(lattice_of(mesh), fixed({2047.5, 2047.5}, 8));
        EXPECT_EQ(plane.centre_q8, fixed({2047.5, 2047.5}, 8));
        for (int j = 0; j < 100; ++j) {
            const Vec2 p{rng.uniform(0, 4095), rng.uniform(0, 4095)};
            const Vec2 expected = mesh.inverse(p);
            const Vec2 found = real(plane_point_q16(plane, fixed(p, 8)), 16);
            // The slopes of the inverse map are rounded to multiples of 2^-24 per px. For both axes
            // together, the error is up to 5e-4 spacings over 4096 px. Points and the origin are
            // rounded to 1/256 px, which is 7e-4 spacings at 6 px per spacing.
            ASSERT_NEAR(found.x, expected.x, 1.2e-3) << "lattice " << i << ", seed " << kSeed;
            ASSERT_NEAR(found.y, expected.y, 1.2e-3) << "lattice " << i << ", seed " << kSeed;
        }
    }
}

TEST(Plane, ImagePointsAreTheInverse) {
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << "plane " << i << ", seed " << kSeed);
        const double side = i % 2 == 0 ? 188 : 2000;
        const PlaneFromImage plane = random_plane(rng, side, i % 3 > 0);
        for (int j = 0; j < 30; ++j) {
            const Vec2 p{rng.uniform(0, side), rng.uniform(0, side)};
            const Vec2 back = real(image_point_q8(plane, fixed(formula(plane, p), 16)), 8);
            const double tolerance = 0.02 + 4e-4 * length(p - real(plane.centre_q8, 8));
            ASSERT_NEAR(back.x, p.x, tolerance);
            ASSERT_NEAR(back.y, p.y, tolerance);
        }
    }
}

TEST(Plane, TheSearchForImagePointsEndsWhereTheMapFolds) {
    // The lens term takes any value that a fit can represent, and the points are far from the
    // fitted dots. Some pattern points then have no image point, but intermediate results must not
    // overflow.
    Rng rng(kSeed);
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE(testing::Message() << "plane " << i << ", seed " << kSeed);
        PlaneFromImage plane = random_plane(rng, 188, true);
        const auto any = [&] { return static_cast<std::int32_t>(rng.bits()) >> rng.below(13); };
        plane.lens_q40 = any();
        if (i % 2 == 1) {
            // A fit to false dots may yield arbitrary values.
            plane.du_q24 = {any(), any()};
            plane.dv_q24 = {any(), any()};
            plane.perspective_q30 = {any(), any()};
        }
        const FixedVec far = fixed({rng.uniform(-250, 250), rng.uniform(-250, 250)}, 16);
        const FixedVec found = image_point_q8(plane, far);
        EXPECT_LE(larger_component(found), 1 << 21);
    }
}

TEST(Plane, TheTangentHasItsValueAndSlope) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "plane " << i << ", seed " << kSeed);
        const PlaneFromImage plane = random_plane(rng, 188, true);
        const Vec2 p = real(fixed({rng.uniform(0, 187), rng.uniform(0, 187)}, 8), 8);
        const PlaneFromImage flat = tangent(plane, fixed(p, 8));
        EXPECT_EQ(flat.perspective_q30, FixedVec{});
        EXPECT_EQ(flat.lens_q40, 0);
        const Vec2 value = formula(plane, p);
        EXPECT_NEAR(formula(flat, p).x, value.x, 4e-5);
        EXPECT_NEAR(formula(flat, p).y, value.y, 4e-5);
        for (const Vec2 step : {Vec2{1, 0}, Vec2{0, 1}}) {
            const Vec2 slope = 0.5 * (formula(plane, p + step) - formula(plane, p - step));
            const Vec2 found = formula(flat, p + step) - formula(flat, p);
            EXPECT_NEAR(found.x, slope.x, 2e-5);
            EXPECT_NEAR(found.y, slope.y, 2e-5);
        }
    }
}

TEST(Plane, TheTangentOfAnAffinePlaneIsThePlane) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "plane " << i << ", seed " << kSeed);
        const PlaneFromImage plane = random_plane(rng, 188, false);
        const Vec2 p = real(fixed({rng.uniform(0, 187), rng.uniform(0, 187)}, 8), 8);
        const PlaneFromImage there = affine_tangent(plane, fixed(p, 8));
        EXPECT_EQ(there.centre_q8, fixed(p, 8));
        for (const Vec2 step : {Vec2{0, 0}, Vec2{20, 0}, Vec2{0, 20}}) {
            EXPECT_NEAR(formula(there, p + step).x, formula(plane, p + step).x, 1e-5);
            EXPECT_NEAR(formula(there, p + step).y, formula(plane, p + step).y, 1e-5);
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test::plane_test
