// The fit's equations against derivatives and solutions computed in double precision.
#include "core/pose/normal.hpp"

#include <gtest/gtest.h>

#include "../geometry.hpp"
#include "core/plane.hpp"

namespace dotpose::core_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 61;
constexpr int kReach_px = 94;

/// A camera some degrees tilted, with a lens that bends.
PlaneFromImage random_plane(Rng& rng) {
    const double theta = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const double per_px = 1 / rng.uniform(8, 14);
    const auto small = [&](double most, double unit) {
        return static_cast<std::int32_t>(std::lround(rng.uniform(-most, most) * unit));
    };
    PlaneFromImage plane;
    plane.centre_q8 = fixed({93.5, 59.5}, 8);
    plane.at_centre_q16 = fixed({rng.uniform(-20, 20), rng.uniform(-20, 20)}, 16);
    plane.du_q24 = fixed(per_px * Vec2{std::cos(theta), std::sin(theta)}, 24);
    plane.dv_q24 = fixed(1.02 * per_px * Vec2{-std::sin(theta), std::cos(theta)}, 24);
    plane.perspective_q30 = {small(1e-3, 1 << 30), small(1e-3, 1 << 30)};
    plane.lens_q40 = small(4e-6, std::pow(2, 40));
    return plane;
}

Vec random_pixel_q8(Rng& rng) {
    return fixed({rng.uniform(0, 187), rng.uniform(0, 119)}, 8);
}

TEST(ScaledPlane, SeesPointsWhereThePlaneHasThem) {
    Rng rng(kSeed);
    for (int i = 0; i < 1000; ++i) {
        const PlaneFromImage plane = random_plane(rng);
        const Vec pixel_q8 = random_pixel_q8(rng);
        const auto sight = ScaledPlane(plane, kReach_px).look(pixel_q8);
        const Vec2 expected =
            real(plane_point_q16(plane, pixel_q8), 16) - real(plane.at_centre_q16, 16);
        ASSERT_NEAR(sight.x, expected.x, 3e-5) << "plane " << i << ", seed " << kSeed;
        ASSERT_NEAR(sight.y, expected.y, 3e-5) << "plane " << i << ", seed " << kSeed;
    }
}

TEST(ScaledPlane, ChangesAsItsDerivativesTell) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        const PlaneFromImage plane = random_plane(rng);
        const ScaledPlane scaled(plane, kReach_px);
        for (std::size_t k = 0; k < kPoseParameters; ++k) {
            SCOPED_TRACE(testing::Message() << "plane " << i << ", parameter " << k);
            constexpr float kStep = 2e-3F;
            Parameters more{};
            more[k] = kStep;
            Parameters less{};
            less[k] = -kStep;
            const Vec pixel_q8 = random_pixel_q8(rng);
            const Vec2 change = (1 / (2.0 * static_cast<double>(kStep))) *
                                (real(plane_point_q16(scaled.changed(more), pixel_q8), 16) -
                                 real(plane_point_q16(scaled.changed(less), pixel_q8), 16));
            const auto sight = scaled.look(pixel_q8);
            // Points are rounded to 2^-16 spacings.
            ASSERT_NEAR(sight.jacobian[0][k], change.x, 0.02);
            ASSERT_NEAR(sight.jacobian[1][k], change.y, 0.02);
        }
    }
}

TEST(ScaledPlane, DistortionsAreWhatMakesItDifferFromAPlainCamera) {
    Rng rng(kSeed);
    const PlaneFromImage plane = random_plane(rng);
    const ScaledPlane scaled(plane, kReach_px);
    Parameters off = scaled.distortions();
    for (float& value : off)
        value = -value;
    const PlaneFromImage plain = scaled.changed(off);
    EXPECT_EQ(plain.perspective_q30, Vec{});
    EXPECT_EQ(plain.lens_q40, 0);
    EXPECT_NEAR(plain.du_q24.x, plain.dv_q24.y, 2);
    EXPECT_NEAR(plain.du_q24.y, -plain.dv_q24.x, 2);
}

/// Sights of many points, with residuals that a known step explains.
struct Problem {
    ScaledPlane plane;
    Normal normal;
    double squared_residuals = 0;

    Problem(const Parameters& step, Rng& rng, bool on_one_line = false)
        : plane(random_plane(rng), kReach_px) {
        for (int i = 0; i < 150; ++i) {
            Vec pixel_q8 = random_pixel_q8(rng);
            if (on_one_line) pixel_q8.y = fixed({0, 59.5}, 8).y;
            const auto sight = plane.look(pixel_q8);
            Vec2 residual{};
            for (std::size_t k = 0; k < kPoseParameters; ++k) {
                residual = residual + static_cast<double>(step[k]) *
                                          Vec2{sight.jacobian[0][k], sight.jacobian[1][k]};
            }
            squared_residuals += residual.x * residual.x + residual.y * residual.y;
            normal.add(sight.jacobian, static_cast<float>(residual.x),
                       static_cast<float>(residual.y));
        }
    }
};

TEST(Normal, FindsTheStepThatExplainsTheResiduals) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        Parameters step;
        for (float& value : step)
            value = static_cast<float>(rng.uniform(-0.1, 0.1));
        Problem problem(step, rng);
        EXPECT_EQ(problem.normal.points(), 150);
        EXPECT_NEAR(problem.normal.squared_residuals(), problem.squared_residuals,
                    1e-4 * problem.squared_residuals);
        ASSERT_TRUE(problem.normal.decompose());
        const Parameters white = problem.normal.whitened(problem.normal.right());
        // Nothing is left unexplained.
        double explained = 0;
        for (const float part : white)
            explained += static_cast<double>(part * part);
        EXPECT_NEAR(explained, problem.squared_residuals, 1e-3 * problem.squared_residuals);
        const Parameters found = problem.normal.unwhitened(white);
        const Parameters back = problem.normal.times_transposed(step);
        for (std::size_t k = 0; k < kPoseParameters; ++k) {
            EXPECT_NEAR(found[k], step[k], 2e-3) << "problem " << i << ", parameter " << k;
            EXPECT_NEAR(back[k], white[k], 2e-2) << "problem " << i << ", parameter " << k;
        }
    }
}

TEST(Normal, CountsAPointOfWeightThreeThreeTimes) {
    Rng rng(kSeed);
    const ScaledPlane plane(random_plane(rng), kReach_px);
    Normal weighted;
    Normal repeated;
    for (int i = 0; i < 40; ++i) {
        const auto sight = plane.look(random_pixel_q8(rng));
        const auto residual = static_cast<float>(rng.uniform(-1, 1));
        weighted.add(sight.jacobian, residual, -residual, 3);
        for (int n = 0; n < 3; ++n)
            repeated.add(sight.jacobian, residual, -residual);
    }
    EXPECT_EQ(weighted.points(), 40);
    EXPECT_NEAR(weighted.squared_residuals(), repeated.squared_residuals(), 1e-3);
    for (std::size_t k = 0; k < kPoseParameters; ++k)
        EXPECT_NEAR(weighted.right()[k], repeated.right()[k], 1e-2);
    ASSERT_TRUE(weighted.decompose() && repeated.decompose());
    for (std::size_t k = 0; k < kPoseParameters; ++k)
        EXPECT_NEAR(weighted.factor(k, k), repeated.factor(k, k), 1e-2);
}

TEST(Normal, LeavesOutWhatThePointsDoNotDetermine) {
    // On one line, the terms with y cannot be told from others.
    Rng rng(kSeed);
    Problem problem({0.01F, -0.02F, 0.03F, 0.01F}, rng, true);
    ASSERT_TRUE(problem.normal.decompose());
    int determined = 0;
    for (std::size_t k = 0; k < kPoseParameters; ++k)
        determined += problem.normal.determines(k) ? 1 : 0;
    EXPECT_LT(determined, 9);
    const Parameters found =
        problem.normal.unwhitened(problem.normal.whitened(problem.normal.right()));
    EXPECT_NEAR(found[0], 0.01, 1e-3);
    EXPECT_NEAR(found[1], -0.02, 1e-3);
}

TEST(Normal, NeedsPoints) {
    Normal none;
    EXPECT_FALSE(none.decompose());
    Normal one;
    one.add(ScaledPlane({{}, {}, {1 << 20, 0}, {0, 1 << 20}, {}, 0}, 10).look({256, 256}).jacobian,
            0, 0);
    EXPECT_FALSE(one.decompose());
}

}  // namespace
}  // namespace dotpose::core_test
