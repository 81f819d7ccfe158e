// Tests the least-squares fit of maps from image points to cells, against double precision and
// against affine_fit_int64.hpp.
#include "device/affine_fit_int32.hpp"

#include <gtest/gtest.h>

#include "../core/geometry.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core_test::affine_fit_int32_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 49;

struct Pair {
    FixedVec p_q3;  ///< offset from the centre, in 1/8 px
    FixedVec cell;
};

/// Returns displaced dots at random positions in the view, each with its cell.
std::vector<Pair> random_pairs(Rng& rng, double reach_px, double spacing, int count) {
    const Mesh mesh =
        square_mesh(spacing, rng.uniform(0, 6.3), {rng.uniform(-20, 20), rng.uniform(-20, 20)});
    std::vector<Pair> pairs;
    for (int i = 0; i < count; ++i) {
        const Vec2 p{rng.uniform(-reach_px, reach_px), rng.uniform(-reach_px, reach_px)};
        const Vec2 g = mesh.inverse(p) + random_displacement(rng);
        pairs.push_back({fixed(p, 3), fixed(g, 0)});
    }
    return pairs;
}

AffineFitInt32 fit_of(const std::vector<Pair>& pairs) {
    AffineFitInt32 fit;
    for (const Pair& pair : pairs)
        fit.add(pair.p_q3, pair.cell);
    return fit;
}

/// Least-squares solution of one coordinate: its value at the centre, and its slopes per px.
struct Solution {
    long double at_centre;
    long double du;
    long double dv;
};

Solution least_squares(const std::vector<Pair>& pairs, std::int32_t FixedVec::*coordinate) {
    const auto n = static_cast<long double>(pairs.size());
    long double mx = 0, my = 0, mt = 0;
    for (const Pair& pair : pairs) {
        mx += pair.p_q3.x / 8.0L / n;
        my += pair.p_q3.y / 8.0L / n;
        mt += pair.cell.*coordinate / n;
    }
    long double xx = 0, xy = 0, yy = 0, xt = 0, yt = 0;
    for (const Pair& pair : pairs) {
        const long double x = pair.p_q3.x / 8.0L - mx;
        const long double y = pair.p_q3.y / 8.0L - my;
        const long double t = pair.cell.*coordinate - mt;
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xt += x * t;
        yt += y * t;
    }
    const long double determinant = xx * yy - xy * xy;
    const long double du = (xt * yy - yt * xy) / determinant;
    const long double dv = (yt * xx - xt * xy) / determinant;
    return {mt - du * mx - dv * my, du, dv};
}

TEST(AffineFitInt32, IsTheLeastSquaresSolution) {
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << "fit " << i << ", seed " << kSeed);
        // The number of dots varies from six to the maximum of 2^14. The size of the view varies
        // from a small window to the largest image.
        const int count = i % 10 == 9 ? 1 << 14 : 6 + static_cast<int>(rng.below(400));
        const double reach = i % 3 == 0 ? 2048 : rng.uniform(40, 300);
        const auto pairs = random_pairs(rng, reach, i % 3 == 0 ? 6 : rng.uniform(6, 30), count);
        PlaneFromImage plane;
        plane.centre_q8 = {123, 456};
        AffineFitInt32 fit = fit_of(pairs);
        EXPECT_EQ(fit.count(), count);
        ASSERT_TRUE(fit.solve(0, plane));
        const Solution x = least_squares(pairs, &FixedVec::x);
        const Solution y = least_squares(pairs, &FixedVec::y);
        // The moments have about 28 significant bits. Slopes are therefore accurate to 3 * 2^-24,
        // and values at the edges of the view to 1/1000 spacing.
        constexpr double kSlope = 3.0 / (1 << 24);
        EXPECT_NEAR(std::ldexp(plane.du_q24.x, -24), static_cast<double>(x.du), kSlope);
        EXPECT_NEAR(std::ldexp(plane.dv_q24.x, -24), static_cast<double>(x.dv), kSlope);
        EXPECT_NEAR(std::ldexp(plane.du_q24.y, -24), static_cast<double>(y.du), kSlope);
        EXPECT_NEAR(std::ldexp(plane.dv_q24.y, -24), static_cast<double>(y.dv), kSlope);
        // The value at the centre is computed from the value at the mean point, so it also contains
        // the error of the slopes.
        const double tolerance = 2.0 / 65536 + kSlope * 0.3 * reach;
        EXPECT_NEAR(real(plane.at_centre_q16, 16).x, static_cast<double>(x.at_centre), tolerance);
        EXPECT_NEAR(real(plane.at_centre_q16, 16).y, static_cast<double>(y.at_centre), tolerance);
        EXPECT_EQ(plane.centre_q8, (FixedVec{123, 456}));
        EXPECT_TRUE(is_affine(plane));
    }
}

TEST(AffineFitInt32, PointsTakenAwayAgainLeaveNoTrace) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        const double reach = i % 3 == 0 ? 2048 : rng.uniform(40, 300);
        const auto kept = random_pairs(rng, reach, 8, 6 + static_cast<int>(rng.below(200)));
        const auto others = random_pairs(rng, reach, 8, static_cast<int>(rng.below(200)));
        AffineFitInt32 changed;
        for (const Pair& pair : others)
            changed.count(pair.p_q3, pair.cell, 1);
        for (const Pair& pair : kept)
            changed.count(pair.p_q3, pair.cell, 1);
        for (const Pair& pair : others)
            changed.count(pair.p_q3, pair.cell, -1);
        AffineFitInt32 fit = fit_of(kept);
        EXPECT_EQ(changed.count(), fit.count());
        PlaneFromImage expected;
        PlaneFromImage plane;
        ASSERT_EQ(changed.solve(0, plane), fit.solve(0, expected));
        EXPECT_EQ(plane.at_centre_q16, expected.at_centre_q16) << i << ", seed " << kSeed;
        EXPECT_EQ(plane.du_q24, expected.du_q24);
        EXPECT_EQ(plane.dv_q24, expected.dv_q24);
    }
}

/// The least-squares affine map in double precision, relative to the mean of the points.
struct RealFit {
    Vec2 mean_px, mean_target, dx, dy;

    explicit RealFit(const std::vector<Pair>& pairs) {
        const double n = static_cast<double>(pairs.size());
        for (const Pair& pair : pairs) {
            mean_px = mean_px + (1 / n) * real(pair.p_q3, 3);
            mean_target = mean_target + (1 / n) * real(pair.cell, 0);
        }
        double uu = 0, uv = 0, vv = 0;
        Vec2 u_target, v_target;
        for (const Pair& pair : pairs) {
            const Vec2 p = real(pair.p_q3, 3) - mean_px;
            const Vec2 target = real(pair.cell, 0) - mean_target;
            uu += p.x * p.x;
            uv += p.x * p.y;
            vv += p.y * p.y;
            u_target = u_target + p.x * target;
            v_target = v_target + p.y * target;
        }
        const double determinant = uu * vv - uv * uv;
        dx = (vv / determinant) * u_target - (uv / determinant) * v_target;
        dy = (uu / determinant) * v_target - (uv / determinant) * u_target;
    }
    Vec2 at_centre() const { return mean_target - mean_px.x * dx - mean_px.y * dy; }
};

TEST(AffineFitInt32, AgreesWithTheFitInDoublePrecision) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "fit " << i << ", seed " << kSeed);
        const auto pairs = random_pairs(rng, 94, rng.uniform(6, 16), 150);
        const RealFit expected(pairs);
        PlaneFromImage plane;
        ASSERT_TRUE(fit_of(pairs).solve(0, plane));
        constexpr double kQ24 = 1 << 24;
        EXPECT_NEAR(plane.du_q24.x, kQ24 * expected.dx.x, 8);
        EXPECT_NEAR(plane.dv_q24.x, kQ24 * expected.dy.x, 8);
        EXPECT_NEAR(plane.du_q24.y, kQ24 * expected.dx.y, 8);
        EXPECT_NEAR(plane.dv_q24.y, kQ24 * expected.dy.y, 8);
        EXPECT_NEAR(plane.at_centre_q16.x, 65536 * expected.at_centre().x, 4);
        EXPECT_NEAR(plane.at_centre_q16.y, 65536 * expected.at_centre().y, 4);
    }
}

TEST(AffineFitInt32, TargetsMayBePartsOfCells) {
    // Targets are points of a known plane, rounded to `bits` fractional bits.
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        const int bits = i % 11;
        SCOPED_TRACE(testing::Message() << "fit " << i << ", " << bits << " bits, seed " << kSeed);
        const Mesh mesh = square_mesh(rng.uniform(6, 16), rng.uniform(0, 6.3),
                                      {rng.uniform(-20, 20), rng.uniform(-20, 20)});
        std::vector<Pair> pairs;
        for (int d = 0; d < 400; ++d) {
            const FixedVec p = fixed({rng.uniform(-94, 94), rng.uniform(-60, 60)}, 3);
            pairs.push_back({p, fixed(mesh.inverse(real(p, 3)), bits)});
        }
        PlaneFromImage plane;
        ASSERT_TRUE(fit_of(pairs).solve(bits, plane));
        // Rounding a target to `bits` fractional bits causes an rms error of 0.29 units in the last
        // place. The error of the mean of 400 targets is 1/20 of this, and the error of the plane
        // at the image edges is up to 3/20 of this. The tolerance is five standard deviations of
        // the mean.
        const double tolerance = std::ldexp(5 * 0.29 / 20, -bits) + 1e-4;
        const Vec2 zero = mesh.inverse({0, 0});
        EXPECT_NEAR(real(plane.at_centre_q16, 16).x, zero.x, tolerance);
        EXPECT_NEAR(real(plane.at_centre_q16, 16).y, zero.y, tolerance);
        for (const Vec2 p : {Vec2{94, 0}, Vec2{0, 60}}) {
            const Vec2 exact = mesh.inverse(p) - zero;
            const Vec2 found = p.x * real(plane.du_q24, 24) + p.y * real(plane.dv_q24, 24);
            EXPECT_NEAR(found.x, exact.x, 3 * tolerance);
            EXPECT_NEAR(found.y, exact.y, 3 * tolerance);
        }
    }
}

TEST(AffineFitInt32, PointsOnALineDetermineNothing) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        const double angle = rng.uniform(0, 6.3);
        const Vec2 along{std::cos(angle), std::sin(angle)};
        const Vec2 across{-along.y, along.x};
        std::vector<Pair> on_line;
        std::vector<Pair> beside;
        for (int k = -40; k <= 40; ++k) {
            const FixedVec cell = fixed(k / 4.0 * along, 0);
            on_line.push_back({fixed(3.0 * k * along, 3), cell});
            // The points of the second set are on both sides of the line. The set is an eighth as
            // wide as it is long.
            beside.push_back({fixed(3.0 * k * along + (k % 2 == 0 ? 15 : -15) * across, 3), cell});
        }
        PlaneFromImage plane;
        EXPECT_FALSE(fit_of(on_line).solve(0, plane)) << angle;
        EXPECT_TRUE(fit_of(beside).solve(0, plane)) << angle;
    }
}

TEST(AffineFitInt32, TwoPointsDetermineNothing) {
    PlaneFromImage plane;
    EXPECT_FALSE(fit_of({}).solve(0, plane));
    EXPECT_FALSE(fit_of({{{0, 0}, {0, 0}}, {{80, 0}, {1, 0}}}).solve(0, plane));
    EXPECT_TRUE(fit_of({{{0, 0}, {0, 0}}, {{80, 0}, {1, 0}}, {{0, 80}, {0, 1}}}).solve(0, plane));
    EXPECT_NEAR(plane.du_q24.x, 0.1 * (1 << 24), 2);
    EXPECT_NEAR(plane.dv_q24.x, 0, 2);
    EXPECT_NEAR(plane.du_q24.y, 0, 2);
    EXPECT_NEAR(plane.dv_q24.y, 0.1 * (1 << 24), 2);
}

}  // namespace
}  // namespace dotpose::core_test::affine_fit_int32_test
