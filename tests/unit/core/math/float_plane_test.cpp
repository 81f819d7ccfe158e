// Compares planes in single precision to the plane formula in double precision.
#include "core/math/float_plane.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "../float_planes.hpp"
#include "../planes.hpp"

namespace dotpose::core_test::float_plane_test {
namespace {

using core::FloatPlane;

constexpr std::uint64_t kSeed = 72;

Vec2 as_vec2(core::FloatVec v) {
    return {v.x, v.y};
}

core::FloatVec as_float(Vec2 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

TEST(FloatPlane, PointsAreThoseOfTheFormula) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        FloatPlane plane = random_float_plane(rng.uniform(6, 60), rng.uniform(0, 2e-3), rng);
        plane.bend = static_cast<float>(rng.uniform(-1e-6, 1e-6));
        const Vec2 px{rng.uniform(-150, 150), rng.uniform(-150, 150)};
        EXPECT_LT(length(as_vec2(core::plane_point(plane, as_float(px))) - formula(plane, px)),
                  1e-4);
    }
}

TEST(FloatPlane, FarAwayItDoesNotFold) {
    FloatPlane plane;
    plane.du_x = plane.dv_y = 0.1F;
    plane.tilt_x = -0.01F;
    EXPECT_FLOAT_EQ(core::plane_point(plane, {75, 10}).x, 30);
    // Beyond this point, the divisor does not decrease below 1/4.
    EXPECT_FLOAT_EQ(core::plane_point(plane, {100, 10}).x, 40);
    EXPECT_FLOAT_EQ(core::plane_point(plane, {200, 10}).y, 4);
}

TEST(FloatPlane, RecentredIsTheSamePlane) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        const FloatPlane plane = random_float_plane(rng.uniform(6, 60), rng.uniform(0, 1e-3), rng);
        const Vec2 to{rng.uniform(-100, 100), rng.uniform(-100, 100)};
        const FloatPlane other = core::recentred(plane, as_float(to));
        for (int k = 0; k < 10; ++k) {
            const Vec2 px{rng.uniform(-100, 100), rng.uniform(-100, 100)};
            EXPECT_LT(length(formula(other, px) - formula(plane, px + to)), 1e-4) << i;
        }
    }
}

TEST(FloatPlane, SpacingIsThatOfItsSquares) {
    Rng rng(kSeed);
    for (const double spacing_px : {5.0, 11.0, 60.0}) {
        const FloatPlane plane = random_float_plane(spacing_px, 0, rng);
        const Vec2 u = formula(plane, {1, 0}) - formula(plane, {});
        const Vec2 v = formula(plane, {0, 1}) - formula(plane, {});
        EXPECT_NEAR(core::spacing_px(plane), 1 / std::sqrt(u.x * v.y - u.y * v.x), 1e-3);
    }
}

TEST(FloatPlane, FixedPointKeepsIt) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        FloatPlane plane = random_float_plane(rng.uniform(6, 60), rng.uniform(0, 1e-3), rng);
        plane.bend = static_cast<float>(rng.uniform(-1e-6, 1e-6));
        const Vec2 centre{93.5, 59.5};
        const PlaneFromImage fixed_point = core::fixed_plane(plane, fixed(centre, 8));
        EXPECT_EQ(fixed_point.centre_q8, fixed(centre, 8));
        const FloatPlane back = core::float_plane(fixed_point);
        for (int k = 0; k < 10; ++k) {
            const Vec2 px{rng.uniform(-90, 90), rng.uniform(-60, 60)};
            EXPECT_LT(length(formula(fixed_point, px + centre) - formula(plane, px)), 4e-5);
            EXPECT_LT(length(formula(back, px) - formula(plane, px)), 4e-5);
        }
    }
}

TEST(FloatPlane, WhatIsBeyondReasonIsCutOff) {
    FloatPlane plane;
    plane.at_x = 1e30F;
    plane.at_y = -std::numeric_limits<float>::infinity();
    plane.du_x = std::numeric_limits<float>::quiet_NaN();
    const PlaneFromImage cut = core::fixed_plane(plane, {});
    EXPECT_EQ(cut.at_centre_q16.x, core::kBeyondReason);
    EXPECT_EQ(cut.at_centre_q16.y, -core::kBeyondReason);
    EXPECT_LE(std::abs(cut.du_q24.x), core::kBeyondReason);
}

TEST(FloatPlane, TellsWhatACameraMaySee) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        const FloatPlane good = random_float_plane(rng.uniform(5, 80), rng.uniform(0, 4e-3), rng);
        ASSERT_TRUE(core::is_within_reason(good, 94, 60));
        // NaN and infinity must be refused in every number of the plane.
        for (float FloatPlane::*number :
             {&FloatPlane::at_x, &FloatPlane::at_y, &FloatPlane::du_x, &FloatPlane::du_y,
              &FloatPlane::dv_x, &FloatPlane::dv_y, &FloatPlane::tilt_x, &FloatPlane::tilt_y,
              &FloatPlane::bend}) {
            for (const float value :
                 {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                  -std::numeric_limits<float>::infinity()}) {
                FloatPlane bad = good;
                bad.*number = value;
                EXPECT_FALSE(core::is_within_reason(bad, 94, 60)) << i;
            }
        }
        // The plane is seen from behind.
        FloatPlane bad = good;
        std::swap(bad.du_x, bad.dv_x);
        std::swap(bad.du_y, bad.dv_y);
        EXPECT_FALSE(core::is_within_reason(bad, 94, 60));
        // The perspective is too strong within the image, or the origin of the plane is far away.
        bad = good;
        bad.tilt_x = 0.01F;
        EXPECT_FALSE(core::is_within_reason(bad, 94, 60));
        bad = good;
        bad.at_y = 1e6F;
        EXPECT_FALSE(core::is_within_reason(bad, 94, 60));
        // The plane is seen edge-on, so du and dv are almost parallel.
        bad = good;
        bad.dv_x = bad.du_x + 0.1F * good.dv_x;
        bad.dv_y = bad.du_y + 0.1F * good.dv_y;
        EXPECT_FALSE(core::is_within_reason(bad, 94, 60));
    }
    EXPECT_FALSE(core::is_within_reason(FloatPlane{}, 94, 60));
    EXPECT_FALSE(core::is_within_reason(random_float_plane(2, 0, rng), 94, 60));
    EXPECT_FALSE(core::is_within_reason(random_float_plane(1000, 0, rng), 94, 60));
}

}  // namespace
}  // namespace dotpose::core_test::float_plane_test
