// Tests fits on sheets that are not planar. The positions of the dots are computed in double
// precision from a plane and a known displacement.
#include "core/pose/uneven.hpp"

#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "../float_planes.hpp"
#include "core/kernels/select.hpp"
#include "core/pose/covariance.hpp"
#include "core/pose/float_fit.hpp"
#include "owned_dots.hpp"

namespace dotpose::core_test::uneven_test {
namespace {

using core::FloatPlane;

constexpr std::uint64_t kSeed = 229;
constexpr double kDisplacement = 1 / 6.0;
constexpr int kReach_px = 95;
constexpr double kJitter = 0.02;
constexpr double kMaxSigmas = 4.5;

/// The displacement of the paper, in spacings, at a position relative to the image centre.
using Shift = std::function<Vec2(Vec2)>;

/// A sheet whose paper is displaced by a `Shift`. Contains its dots in an image of 188 x 120 px,
/// and the pose fitted to these dots.
struct Sheet {
    FloatPlane truth;
    OwnedDots owned;
    FloatPlane plane;
    core::PoseFit fit;
    Fix fix;
    std::vector<float> columns;
    bool is_fitted = false;
    bool may_be_divided = false;  ///< result of `core::may_be_divided`

    Sheet(const Shift& shift, Rng& rng) : Sheet(random_float_plane(11, 2e-4, rng), shift, rng) {}
    Sheet(const FloatPlane& upright, const Shift& shift, Rng& rng) : truth(upright) {
        const Vec2 centre = formula(truth, {});
        for (int j = -14; j <= 14; ++j) {
            for (int i = -14; i <= 14; ++i) {
                const auto symbol = static_cast<Symbol>(rng.below(4));
                const Vec2 meant{i + kDisplacement * dx(symbol), j + kDisplacement * dy(symbol)};
                const Vec2 place =
                    meant + shift(meant - centre) + kJitter * Vec2{rng.normal(), rng.normal()};
                const Vec2 px = image_of(truth, place);
                if (std::abs(px.x) < 92 && std::abs(px.y) < 58) owned.add({i, j}, symbol, px);
            }
        }
        columns.assign(owned.dots.column.begin(), owned.dots.column.end());
        plane = truth;
        constexpr auto kLimit = static_cast<float>(0.25 * 0.25);
        is_fitted = core::fit_plane(core::kernels(), owned.dots, kReach_px, kLimit,
                                    static_cast<float>(kDisplacement), plane, fit);
        if (!is_fitted) return;
        may_be_divided = core::may_be_divided(core::kernels(), owned.dots, plane, fit);
        core::fit_uneven(core::kernels(), owned.dots, {}, plane, fit);
        core::estimate_covariance(fit, core::fixed_plane(plane, {}), {}, fix);
    }

    bool is_as_it_was() const {
        return std::equal(columns.begin(), columns.end(), owned.dots.column.begin());
    }
    Vec2 off() const { return formula(plane, {}) - formula(truth, {}); }
    /// Divides the errors of x and y by their standard deviations, and returns the larger quotient.
    double sigmas_off() const {
        return std::max(std::abs(off().x) / std::sqrt(double{fix.covariance[0][0]}),
                        std::abs(off().y) / std::sqrt(double{fix.covariance[1][1]}));
    }
};

/// Returns a step in the paper. Points whose coordinate along the direction exceeds `distance` are
/// displaced by `by`.
Shift slip(double distance, double direction_rad, Vec2 by) {
    return [=](Vec2 place) {
        const double t = std::cos(direction_rad) * place.x + std::sin(direction_rad) * place.y;
        return t > distance ? by : Vec2{};
    };
}

TEST(FitUneven, LeavesFitsOfFlatSheetsAlone) {
    Rng rng(kSeed);
    int uneven = 0;
    int may_be_divided = 0;
    for (int trial = 0; trial < 100; ++trial) {
        SCOPED_TRACE(testing::Message() << trial << ", seed " << kSeed);
        const Sheet sheet([](Vec2) { return Vec2{}; }, rng);
        ASSERT_TRUE(sheet.is_fitted);
        may_be_divided += sheet.may_be_divided ? 1 : 0;
        uneven += sheet.fix.surface != Surface::even ? 1 : 0;
        EXPECT_LT(sheet.sigmas_off(), kMaxSigmas);
    }
    EXPECT_LE(uneven, 1);
    EXPECT_LE(may_be_divided, 3);
}

TEST(FitUneven, FitsTheSideOfTheReferencePoint) {
    Rng rng(kSeed);
    int divided = 0;
    for (int trial = 0; trial < 60; ++trial) {
        SCOPED_TRACE(testing::Message() << trial << ", seed " << kSeed);
        const double moves_rad = rng.uniform(0, 6.283);
        const double by = rng.uniform(0.10, 0.5);
        const Sheet sheet(slip(rng.uniform(1.6, 3), rng.uniform(0, 6.283),
                               {by * std::cos(moves_rad), by * std::sin(moves_rad)}),
                          rng);
        ASSERT_TRUE(sheet.is_fitted);
        EXPECT_TRUE(sheet.may_be_divided);
        EXPECT_NE(sheet.fix.surface, Surface::even);
        EXPECT_LT(sheet.sigmas_off(), kMaxSigmas);
        EXPECT_TRUE(sheet.is_as_it_was());
        if (sheet.fix.surface != Surface::divided) continue;
        ++divided;
        EXPECT_LT(length(sheet.off()), 0.02);
        EXPECT_LT(sheet.fix.dots_used, sheet.owned.dots.count * 9 / 10);
    }
    // In some trials, the estimated line is not exactly the true line, and does not explain all
    // residuals. The sheet is then classified as uneven.
    EXPECT_GE(divided, 55);
}

TEST(FitUneven, LeavesOpenWhichSideAReferencePointAtTheLineIsOn) {
    Rng rng(kSeed);
    for (int trial = 0; trial < 30; ++trial) {
        SCOPED_TRACE(testing::Message() << trial << ", seed " << kSeed);
        const Sheet sheet(slip(rng.uniform(-0.2, 0.2), rng.uniform(0, 6.283), {0.3, -0.2}), rng);
        ASSERT_TRUE(sheet.is_fitted);
        EXPECT_NE(sheet.fix.surface, Surface::even);
        EXPECT_LT(sheet.sigmas_off(), 2);
        EXPECT_GT(sheet.fix.covariance[0][0], 0.2 * 0.2);
        EXPECT_GT(sheet.fix.covariance[1][1], 0.13 * 0.13);
    }
}

// A plane absorbs most of a small step in the middle of the view, and the residuals of each row
// that crosses the step have a mean of 0. Regression: for these two reasons, the step was not
// found, and the sheet was classified as even, with errors of up to 24 standard deviations.
TEST(FitUneven, SeesASmallStepInTheMiddle) {
    Rng rng(kSeed);
    int claim_too_much = 0;
    for (int trial = 0; trial < 40; ++trial) {
        SCOPED_TRACE(testing::Message() << trial << ", seed " << kSeed);
        const FloatPlane upright = random_float_plane(11, 0, rng);
        const double across_rows = rng.uniform(-0.3, 0.3);
        const double by = rng.uniform(0.06, 0.13);
        const double moves_rad = rng.uniform(0, 6.283);
        const Sheet sheet(
            upright, slip(0.1, across_rows, {by * std::cos(moves_rad), by * std::sin(moves_rad)}),
            rng);
        ASSERT_TRUE(sheet.is_fitted);
        claim_too_much += sheet.sigmas_off() > 4 ? 1 : 0;
    }
    // The fast attempts search for a line only if the scatter between blocks is large, so they miss
    // a few small steps.
    EXPECT_LE(claim_too_much, 2);
}

// Simulates printed words over part of the view: beyond a line, 40 % of the dots have a random
// error of 0.3 spacings rms per axis. Regression: such sheets were classified as divided, and the
// pose was fitted to only some of the dots.
TEST(FitUneven, WordsDivideNoSheet) {
    Rng rng(kSeed);
    for (int trial = 0; trial < 40; ++trial) {
        SCOPED_TRACE(testing::Message() << trial << ", seed " << kSeed);
        const double turned_rad = rng.uniform(0, 6.283);
        const Sheet sheet(
            [&](Vec2 place) {
                const double t = std::cos(turned_rad) * place.x + std::sin(turned_rad) * place.y;
                const bool is_near_word = t > 2 && rng.uniform() < 0.4;
                return is_near_word ? 0.3 * Vec2{rng.normal(), rng.normal()} : Vec2{};
            },
            rng);
        ASSERT_TRUE(sheet.is_fitted);
        EXPECT_NE(sheet.fix.surface, Surface::divided);
        EXPECT_LT(sheet.sigmas_off(), kMaxSigmas);
    }
}

TEST(FitUneven, WidensTheCovarianceOnWrinkledPaper) {
    Rng rng(kSeed);
    for (int trial = 0; trial < 30; ++trial) {
        SCOPED_TRACE(testing::Message() << trial << ", seed " << kSeed);
        const double phase = rng.uniform(0, 6.283);
        // The paper is not displaced at the reference point.
        const Sheet sheet(
            [=](Vec2 place) {
                constexpr double kTurns = 6.283 / 10;
                return 0.08 * Vec2{std::sin(kTurns * place.x + phase) - std::sin(phase),
                                   std::sin(kTurns * place.y + phase) - std::sin(phase)};
            },
            rng);
        ASSERT_TRUE(sheet.is_fitted);
        EXPECT_NE(sheet.fix.surface, Surface::even);
        EXPECT_LT(sheet.sigmas_off(), kMaxSigmas);
    }
}

}  // namespace
}  // namespace dotpose::core_test::uneven_test
