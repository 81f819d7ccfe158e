// Tests planes that are fitted to dots. The positions of the dots are computed from a plane in
// double precision.
#include "core/pose/float_fit.hpp"

#include <gtest/gtest.h>

#include "../float_planes.hpp"
#include "core/kernels/select.hpp"
#include "core/pose/covariance.hpp"
#include "owned_dots.hpp"

namespace dotpose::core_test::float_fit_test {
namespace {

using core::FloatPlane;

constexpr std::uint64_t kSeed = 78;
constexpr double kDisplacement = 1 / 6.0;
constexpr int kReach_px = 95;

/// Adds the dots on the plane that are visible in an image of 188 x 120 px. A fraction `wrong` of
/// the dots is displaced by up to 4 px per axis.
void show_dots(const FloatPlane& plane, double noise_px, double wrong, Rng& rng, OwnedDots& owned) {
    for (int j = -14; j <= 14; ++j) {
        for (int i = -14; i <= 14; ++i) {
            const auto symbol = static_cast<Symbol>(rng.below(4));
            const Vec2 place{i + kDisplacement * dx(symbol), j + kDisplacement * dy(symbol)};
            Vec2 px = image_of(plane, place) + noise_px * Vec2{rng.normal(), rng.normal()};
            if (!(std::abs(px.x) < 92 && std::abs(px.y) < 58)) continue;
            if (rng.uniform() < wrong) px = px + Vec2{rng.uniform(-4, 4), rng.uniform(-4, 4)};
            owned.add({i, j}, symbol, px);
        }
    }
}

/// Returns an approximation of `truth` without perspective. It has an error of up to 0.08 spacings
/// per axis in position, and small errors in du and dv.
FloatPlane guess_of(const FloatPlane& truth, Rng& rng) {
    FloatPlane guess = truth;
    const auto some = [&](double size) { return static_cast<float>(rng.uniform(-size, size)); };
    guess.at_x += some(0.08);
    guess.at_y += some(0.08);
    guess.du_x += some(4e-4);
    guess.dv_y += some(4e-4);
    guess.tilt_x = guess.tilt_y = 0;
    return guess;
}

double worst_difference(const FloatPlane& a, const FloatPlane& b) {
    double worst = 0;
    for (int v = -60; v <= 60; v += 20) {
        for (int u = -90; u <= 90; u += 30) {
            const Vec2 px{static_cast<double>(u), static_cast<double>(v)};
            worst = std::max(worst, length(formula(a, px) - formula(b, px)));
        }
    }
    return worst;
}

constexpr auto kFirstLimit = static_cast<float>(0.25 * 0.25);

TEST(FitPlane, RecoversThePlaneOfExactDots) {
    Rng rng(kSeed);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(testing::Message() << i << ", seed " << kSeed);
        const FloatPlane truth = random_float_plane(rng.uniform(8, 16), rng.uniform(0, 8e-4), rng);
        OwnedDots owned;
        show_dots(truth, 0, 0, rng, owned);
        FloatPlane plane = guess_of(truth, rng);
        core::PoseFit fit;
        ASSERT_TRUE(core::fit_plane(core::kernels(), owned.dots, kReach_px, kFirstLimit,
                                    static_cast<float>(kDisplacement), plane, fit));
        EXPECT_LT(worst_difference(plane, truth), 2e-4);
        EXPECT_NEAR(fit.displacement, kDisplacement, 1e-3);
    }
}

TEST(FitPlane, SaysHowFarItMayBeOff) {
    Rng rng(kSeed);
    double nees_x = 0;
    double nees_y = 0;
    double nees_theta = 0;
    constexpr int kTrials = 200;
    for (int i = 0; i < kTrials; ++i) {
        const FloatPlane truth = random_float_plane(11, 2e-4, rng);
        OwnedDots owned;
        show_dots(truth, 0.1, 0, rng, owned);
        FloatPlane plane = guess_of(truth, rng);
        core::PoseFit fit;
        ASSERT_TRUE(core::fit_plane(core::kernels(), owned.dots, kReach_px, kFirstLimit,
                                    static_cast<float>(kDisplacement), plane, fit));
        EXPECT_LT(worst_difference(plane, truth), 0.02);
        Fix fix;
        fix.spacing_px_q16 = 11 * 65536;
        const FixedVec centre_q8{};
        core::estimate_covariance(fit, core::fixed_plane(plane, centre_q8), centre_q8, fix);
        const Vec2 off = formula(plane, {}) - formula(truth, {});
        const double turn = std::atan2(double{plane.du_y}, double{plane.du_x}) -
                            std::atan2(double{truth.du_y}, double{truth.du_x});
        const auto square = [](double v) { return v * v; };
        nees_x += square(off.x) / double{fix.covariance[0][0]} / kTrials;
        nees_y += square(off.y) / double{fix.covariance[1][1]} / kTrials;
        nees_theta +=
            square(std::remainder(turn, 6.283185307)) / double{fix.covariance[2][2]} / kTrials;
        EXPECT_NEAR(fix.residual_px, 0.1, 0.03);
    }
    // The mean of 200 squared standard normal variables has a standard deviation of 0.1.
    EXPECT_NEAR(nees_x, 1, 0.35);
    EXPECT_NEAR(nees_y, 1, 0.35);
    EXPECT_NEAR(nees_theta, 1, 0.45);
}

TEST(FitPlane, FollowsTiltsOfTwentyDegreesAndALens) {
    Rng rng(kSeed);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(testing::Message() << i << ", seed " << kSeed);
        FloatPlane truth = random_float_plane(11, rng.uniform(5e-4, 2e-3), rng);
        truth.bend = static_cast<float>(rng.uniform(-4e-6, 4e-6));
        OwnedDots owned;
        show_dots(truth, 0.02, 0, rng, owned);
        FloatPlane plane = guess_of(truth, rng);
        core::PoseFit fit;
        ASSERT_TRUE(core::fit_plane(core::kernels(), owned.dots, kReach_px, 9,
                                    static_cast<float>(kDisplacement), plane, fit));
        EXPECT_LT(worst_difference(plane, truth), 0.01);
        // A second fit must change the plane by less than half a standard deviation.
        FloatPlane again = plane;
        ASSERT_TRUE(core::fit_plane(core::kernels(), owned.dots, kReach_px, 9,
                                    static_cast<float>(kDisplacement), again, fit));
        EXPECT_LT(worst_difference(again, plane), 2e-3);
    }
}

TEST(FitPlane, LeavesOutWhatIsFarOff) {
    Rng rng(kSeed);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(testing::Message() << i << ", seed " << kSeed);
        const FloatPlane truth = random_float_plane(11, 2e-4, rng);
        OwnedDots owned;
        show_dots(truth, 0.05, 0.15, rng, owned);
        FloatPlane plane = guess_of(truth, rng);
        core::PoseFit fit;
        ASSERT_TRUE(core::fit_plane(core::kernels(), owned.dots, kReach_px, kFirstLimit,
                                    static_cast<float>(kDisplacement), plane, fit));
        EXPECT_LT(worst_difference(plane, truth), 0.015);
        EXPECT_LT(fit.normal.points(), owned.dots.count * 93 / 100);
    }
}

TEST(FitPlane, NeedsTwentyDots) {
    Rng rng(kSeed);
    const FloatPlane truth = random_float_plane(11, 0, rng);
    OwnedDots owned;
    show_dots(truth, 0, 0, rng, owned);
    for (std::size_t k = 19; k < owned.dots.x.size(); ++k)
        owned.dots.x[k] = kNoDot_px;
    owned.dots.count = 19;
    FloatPlane plane = truth;
    core::PoseFit fit;
    EXPECT_FALSE(core::fit_plane(core::kernels(), owned.dots, kReach_px, kFirstLimit,
                                 static_cast<float>(kDisplacement), plane, fit));
    owned.dots.count = 0;
    EXPECT_FALSE(core::fit_plane(core::kernels(), owned.dots, kReach_px, kFirstLimit,
                                 static_cast<float>(kDisplacement), plane, fit));
}

}  // namespace
}  // namespace dotpose::core_test::float_fit_test
