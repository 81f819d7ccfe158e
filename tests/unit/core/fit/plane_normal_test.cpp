// Tests the normal equations of the fit against derivatives and solutions that are computed in
// double precision.
#include "core/fit/plane_normal.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "../float_planes.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core_test::plane_normal_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 61;
constexpr int kReach_px = 94;

/// Returns the plane of a camera that is tilted by a few degrees and has lens distortion.
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

FixedVec random_pixel_q8(Rng& rng) {
    return fixed({rng.uniform(0, 187), rng.uniform(0, 119)}, 8);
}

ScaledPlane scaled(const PlaneFromImage& plane) {
    return {float_plane(plane), kReach_px};
}

/// Projects four pixels onto the pattern. The first pixel is `pixel_q8`, and the other three are
/// arbitrary.
FourVecs project(const ScaledPlane& scaled, const PlaneFromImage& plane, FixedVec pixel_q8) {
    const auto x = static_cast<float>(pixel_q8.x - plane.centre_q8.x) / 256;
    const auto y = static_cast<float>(pixel_q8.y - plane.centre_q8.y) / 256;
    return scaled.project(Four{x, 1, -20, 27}, Four{y, -1, 12, 12});
}

TEST(ScaledPlane, SeesPointsWhereThePlaneHasThem) {
    Rng rng(kSeed);
    for (int i = 0; i < 1000; ++i) {
        const PlaneFromImage plane = random_plane(rng);
        const FixedVec pixel_q8 = random_pixel_q8(rng);
        const FourVecs places = project(scaled(plane), plane, pixel_q8);
        const Vec2 expected =
            real(plane_point_q16(plane, pixel_q8), 16) - real(plane.at_centre_q16, 16);
        const auto unit = static_cast<double>(scaled(plane).scale());
        ASSERT_NEAR(double{places.x[0]} * unit, expected.x, 3e-5)
            << "plane " << i << ", seed " << kSeed;
        ASSERT_NEAR(double{places.y[0]} * unit, expected.y, 3e-5)
            << "plane " << i << ", seed " << kSeed;
    }
}

TEST(ScaledPlane, ChangesAsItsDerivativesTell) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        const PlaneFromImage plane = random_plane(rng);
        const FloatPlane seen = float_plane(plane);
        const FixedVec pixel_q8 = random_pixel_q8(rng);
        const Vec2 px = real(pixel_q8, 8) - real(plane.centre_q8, 8);
        const auto derivatives = jacobian(project(scaled(plane), plane, pixel_q8), 0);
        for (std::size_t k = 0; k < kPoseParameters; ++k) {
            SCOPED_TRACE(testing::Message() << "plane " << i << ", parameter " << k);
            constexpr float kStep = 0.01F;
            Parameters more{};
            more[k] = kStep;
            Parameters less{};
            less[k] = -kStep;
            const Vec2 change =
                (1 / (2 * static_cast<double>(kStep))) * (formula(scaled(plane).changed(more), px) -
                                                          formula(scaled(plane).changed(less), px));
            // The tolerance for the lens term, kBend, is larger because the derivative with respect
            // to this term neglects tilt and shear.
            const double most = k == kBend ? 0.15 : 0.002;
            ASSERT_NEAR(derivatives[0][k], change.x, most);
            ASSERT_NEAR(derivatives[1][k], change.y, most);
        }
        // `changed` is exact even for a large change in tilt.
        const Vec2 place = formula(seen, px) - formula(seen, {});
        const double by = 1 + (0.3 * place.x - 0.2 * place.y) / 9;
        const auto unit = scaled(plane).scale();
        Parameters tilt{};
        tilt[kTilt] = -0.3F / 9 * unit * unit;
        tilt[kTilt + 1] = 0.2F / 9 * unit * unit;
        const FloatPlane tilted = scaled(plane).changed(tilt);
        ASSERT_LT(length((1 / by) * place - (formula(tilted, px) - formula(tilted, {}))),
                  2e-4 * length(place) / (by * by));
    }
}

TEST(ScaledPlane, ChangesThatMakeNoSenseAreLimited) {
    Rng rng(kSeed);
    const PlaneFromImage plane = random_plane(rng);
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    for (const float change : {1e12F, -1e12F, kInfinite, -kInfinite, std::nanf("")}) {
        SCOPED_TRACE(testing::Message() << "change " << change);
        Parameters all;
        all.fill(change);
        const PlaneFromImage changed = fixed_plane(scaled(plane).changed(all), {});
        for (const FixedVec part : {changed.at_centre_q16, changed.du_q24, changed.dv_q24,
                                    changed.perspective_q30, FixedVec{changed.lens_q40, 0}}) {
            EXPECT_LE(larger_component(part), 1 << 28);
        }
    }
}

TEST(ScaledPlane, DistortionsAreWhatMakesItDifferFromAPlainCamera) {
    Rng rng(kSeed);
    const PlaneFromImage plane = random_plane(rng);
    Parameters off = scaled(plane).distortions();
    for (float& value : off)
        value = -value;
    const FloatPlane plain = scaled(plane).changed(off);
    EXPECT_NEAR(plain.bend, 0, 1e-11);
    // The tilt is not exactly 0, because removing the shear of about 1 % also rotates the tilt
    // slightly.
    EXPECT_NEAR(plain.tilt_x, 0, 2e-5);
    EXPECT_NEAR(plain.tilt_y, 0, 2e-5);
    EXPECT_NEAR(plain.du_x, plain.dv_y, 2e-5);
    EXPECT_NEAR(plain.du_y, -plain.dv_x, 2e-5);
}

/// Normal equations of many points. The residual of each point is the displacement that results
/// from changing the parameters by `step`.
struct Problem {
    static constexpr int kPoints = 150;
    PlaneNormal normal;
    double squared_residuals = 0;

    Problem(const Parameters& step, Rng& rng, bool on_one_line = false) {
        const ScaledPlane plane = scaled(random_plane(rng));
        PlaneSums sums;
        for (int first = 0; first < kPoints; first += 4) {
            Four x;
            Four y;
            for (int k = 0; k < 4; ++k) {
                x[k] = static_cast<float>(rng.uniform(-93, 93));
                y[k] = on_one_line ? 0 : static_cast<float>(rng.uniform(-59, 59));
            }
            const FourVecs places = plane.project(x, y);
            Residuals residuals{};
            for (int k = 0; k < 4 && first + k < kPoints; ++k) {
                const Vec2 off = explained_by(step, jacobian(places, static_cast<std::size_t>(k)));
                squared_residuals += off.x * off.x + off.y * off.y;
                residuals.offset.x[k] = static_cast<float>(off.x);
                residuals.offset.y[k] = static_cast<float>(off.y);
                residuals.weight[k] = 1;
            }
            sums.add(places, residuals);
        }
        normal = PlaneNormal(sums.all());
    }

    static Vec2 explained_by(const Parameters& step, const std::array<Parameters, 2>& jacobian) {
        Vec2 sum{};
        for (std::size_t k = 0; k < kPoseParameters; ++k)
            sum = sum + static_cast<double>(step[k]) * Vec2{jacobian[0][k], jacobian[1][k]};
        return sum;
    }
};

TEST(PlaneNormal, FindsTheStepThatExplainsTheResiduals) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        Parameters step;
        for (float& value : step)
            value = static_cast<float>(rng.uniform(-0.1, 0.1));
        Problem problem(step, rng);
        EXPECT_EQ(problem.normal.points(), Problem::kPoints);
        EXPECT_NEAR(problem.normal.squared_residuals(), problem.squared_residuals,
                    1e-4 * problem.squared_residuals);
        ASSERT_TRUE(problem.normal.decompose());
        const Parameters white = problem.normal.whitened(problem.normal.right());
        // The step explains all residuals, so the explained sum equals the sum of the squared
        // residuals.
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

double product(float a, float b) {
    return static_cast<double>(a) * static_cast<double>(b);
}

TEST(PlaneNormal, IsThatOfItsDefinition) {
    Rng rng(kSeed);
    const ScaledPlane plane = scaled(random_plane(rng));
    PlaneSums sums;
    double expected[kPoseParameters][kPoseParameters] = {};
    double right[kPoseParameters] = {};
    for (int n = 0; n < 10; ++n) {
        const auto by = static_cast<float>(n);
        const FourVecs places = plane.project(Four{0, -35, 3 * by, 43}, Four{-31, by, 16, 4 * by});
        const Residuals residuals{{Four{0.5F, -1, 2, 0.1F}, Four{1, 0.3F, -0.7F, 0.2F}},
                                  Four{1, 0.5F, 0, 3}};
        sums.add(places, residuals);
        for (int point = 0; point < 4; ++point) {
            const auto [a, b] = jacobian(places, static_cast<std::size_t>(point));
            const auto weight = static_cast<double>(residuals.weight[point]);
            for (std::size_t i = 0; i < kPoseParameters; ++i) {
                right[i] += weight * (product(a[i], residuals.offset.x[point]) +
                                      product(b[i], residuals.offset.y[point]));
                for (std::size_t j = 0; j < kPoseParameters; ++j)
                    expected[i][j] += weight * (product(a[i], a[j]) + product(b[i], b[j]));
            }
        }
    }
    PlaneNormal normal(sums.all());
    EXPECT_EQ(normal.points(), 30);
    for (std::size_t i = 0; i < kPoseParameters; ++i)
        EXPECT_NEAR(normal.right()[i], right[i], 1e-4) << i;
    ASSERT_TRUE(normal.decompose());
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k <= j; ++k)
                sum += product(normal.factor(i, k), normal.factor(j, k));
            EXPECT_NEAR(sum, expected[i][j], 1e-3) << i << ", " << j;
        }
    }
}

TEST(PlaneNormal, CountsAPointOfWeightThreeThreeTimes) {
    Rng rng(kSeed);
    const ScaledPlane plane = scaled(random_plane(rng));
    PlaneSums weighted;
    PlaneSums repeated;
    for (int i = 0; i < 10; ++i) {
        Four x;
        Four y;
        Four off;
        for (int k = 0; k < 4; ++k) {
            x[k] = static_cast<float>(rng.uniform(-93, 93));
            y[k] = static_cast<float>(rng.uniform(-59, 59));
            off[k] = static_cast<float>(rng.uniform(-1, 1));
        }
        const FourVecs places = plane.project(x, y);
        weighted.add(places, {{off, -off}, Four{3, 3, 3, 3}});
        for (int n = 0; n < 3; ++n)
            repeated.add(places, {{off, -off}, Four{1, 1, 1, 1}});
    }
    PlaneNormal one(weighted.all());
    PlaneNormal three(repeated.all());
    EXPECT_EQ(one.points(), 40);
    EXPECT_NEAR(one.squared_residuals(), three.squared_residuals(), 1e-3);
    for (std::size_t k = 0; k < kPoseParameters; ++k)
        EXPECT_NEAR(one.right()[k], three.right()[k], 1e-2);
    ASSERT_TRUE(one.decompose() && three.decompose());
    for (std::size_t k = 0; k < kPoseParameters; ++k)
        EXPECT_NEAR(one.factor(k, k), three.factor(k, k), 1e-2);
}

TEST(PlaneNormal, LeavesOutWhatThePointsDoNotDetermine) {
    // If all points are on one line, y is a function of x, so some parameters are undetermined.
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

TEST(PlaneNormal, NeedsPoints) {
    PlaneNormal none{FitSums()};
    EXPECT_FALSE(none.decompose());
    PlaneSums sums;
    const ScaledPlane plane({0, 0, 0.06F, 0, 0, 0.06F}, 10);
    sums.add(plane.project(Four{1}, Four{1}), {{Four{}, Four{}}, Four{1}});
    PlaneNormal one(sums.all());
    EXPECT_EQ(one.points(), 1);
    EXPECT_FALSE(one.decompose());
}

}  // namespace
}  // namespace dotpose::core_test::plane_normal_test
