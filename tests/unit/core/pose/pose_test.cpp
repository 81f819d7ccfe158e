// Compares the pose computed from the place in the code with the true pose of a camera of known
// geometry.
#include <cmath>

#include <gtest/gtest.h>

#include "core/pose/covariance.hpp"
#include "core/pose/refine_pose.hpp"
#include "core/pose/subgrid.hpp"
#include "poses.hpp"

namespace dotpose::core_test::pose_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 33;

/// The pose fitted to all dots, and the fix computed from this pose for one pixel. The fit starts
/// from the pose of the grid.
struct Fitted {
    bool ok = false;
    PlaneFromImage pose;
    PoseFit fit;
    Fix fix;
};

Fitted fitted(const Reading& reading, Vec2 pixel, const PaperMap* paper = nullptr) {
    const Nominal nominal(reading.grid(), reading.view.code, reading.truth());
    const Observations observations(reading.dots, reading.grid(), nominal, paper);
    Fitted result;
    result.pose = upright_plane(reading.plane, reading.turn);
    result.ok = refine_pose(observations, result.pose, result.fit);
    if (!result.ok) return result;
    write_pose(result.pose, fixed(pixel, 8), reading.view.code, reading.truth().place, result.fix);
    estimate_covariance(result.fit, result.pose, fixed(pixel, 8), result.fix);
    return result;
}

Fitted fitted(const Reading& reading) {
    return fitted(reading, reading.view.centre_px());
}

TEST(Pose, OfTheGridIsThatOfTheCamera) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        View view = random_view(rng);
        view.spacing_px = rng.uniform(6, 11);
        const Reading reading(view, QuarterTurn{i % 4});
        const Vec2 pixel =
            i % 2 == 0 ? view.centre_px() : Vec2{rng.uniform(-50, 250), rng.uniform(-50, 200)};
        expect_pose(reading, upright_plane(reading.plane, reading.turn), pixel, 1e-3);
    }
}

TEST(Pose, FittedToExactDotsIsExact) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        const Reading reading = reading_off_grid(i, rng);
        const Fitted fit = fitted(reading);
        ASSERT_TRUE(fit.ok);
        // The fitted pose is not exact, because dot centres are rounded to 1/256 px. The rounding
        // error varies across the image, and the fit interprets this variation as a slight lens
        // distortion.
        expect_pose(reading, fit.pose, reading.view.centre_px(), 2e-4);
        EXPECT_GE(fit.fix.dots_used, static_cast<int>(reading.dots.size()) * 9 / 10);
    }
}

TEST(Pose, OutliersAreLeftOut) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        const View view = random_view(rng);
        const Reading reading(view, QuarterTurn{i % 4}, dots_with_outliers(view, 0.5, rng));
        const Fitted fit = fitted(reading);
        ASSERT_TRUE(fit.ok);
        expect_pose(reading, fit.pose, view.centre_px(), 1e-4);
        const auto dots = static_cast<int>(reading.dots.size());
        EXPECT_LE(fit.fix.dots_used, dots * 7 / 8);
        EXPECT_GE(fit.fix.dots_used, dots * 3 / 4);
    }
}

TEST(Pose, ADisplacementOtherThanASixthIsMeasured) {
    Rng rng(kSeed);
    for (const double displacement : {0.11, 0.14, 0.2, 0.23}) {
        const View view = random_view(rng);
        const Reading reading(view, QuarterTurn{1}, dots_displaced_by(displacement, view));
        const Fitted fit = fitted(reading);
        ASSERT_TRUE(fit.ok);
        expect_pose(reading, fit.pose, view.centre_px(), 2e-4);
        EXPECT_GE(fit.fix.dots_used, static_cast<int>(reading.dots.size()) * 9 / 10)
            << displacement;
    }
}

TEST(Pose, DotsOnOneLineDetermineNone) {
    Rng rng(kSeed);
    Reading reading(random_view(rng), {});
    for (GridCell& cell : reading.owned.cells)
        cell.dot = GridCell::kNoDot;
    EXPECT_FALSE(fitted(reading).ok);
}

TEST(Pose, IsWrittenAsCellFractionAngleAndSpacing) {
    Rng rng(kSeed);
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE(testing::Message() << "pose " << i << ", seed " << kSeed);
        const Place place = random_place(rng);
        const double theta = rng.uniform(-std::numbers::pi, std::numbers::pi);
        const double spacing = rng.uniform(6, 60);
        const Vec2 at{rng.uniform(-200, 200), rng.uniform(-200, 200)};
        const Vec2 du{std::cos(theta) / spacing, std::sin(theta) / spacing};
        Fix fix;
        const Vec2 centre{rng.uniform(0, 4000), rng.uniform(0, 4000)};
        const PlaneFromImage plane{
            fixed(centre, 8), fixed(at, 16), fixed(du, 24), fixed({-du.y, du.x}, 24), {}, 0};
        auto* const write = i % 2 == 0 ? write_pose : write_affine_pose;
        write(plane, fixed(centre, 8), CodeVariant::anoto, place, fix);
        const auto nearest = [](double value) { return std::remainder(value, kPositionsPerAxis); };
        ASSERT_NEAR(nearest(fix.x_grid() - place.cell.x - at.x), 0, 1e-5);
        ASSERT_NEAR(nearest(fix.y_grid() - place.cell.y - at.y), 0, 1e-5);
        ASSERT_LT(fix.cell.x, kPositionsPerAxis);
        ASSERT_LT(fix.cell.y, kPositionsPerAxis);
        ASSERT_NEAR(std::remainder(fix.theta_rad() - theta, 2 * std::numbers::pi), 0, 1e-5);
        ASSERT_GE(fix.theta_rad(), -std::numbers::pi);
        ASSERT_LT(fix.theta_rad(), std::numbers::pi);
        ASSERT_NEAR(fix.spacing_px(), spacing, 2e-5 * spacing);
    }
}

TEST(Pose, WhereTheMapHardlyMovesTheSpacingSaturates) {
    for (const std::int32_t du_q24 : {0, 1, 511, 512, 513}) {
        const PlaneFromImage plane{{}, {}, {du_q24, 0}, {0, du_q24}, {}, 0};
        for (auto* const write : {write_pose, write_affine_pose}) {
            Fix fix;
            write(plane, {}, CodeVariant::anoto, {}, fix);
            if (du_q24 > 512) {
                EXPECT_NEAR(fix.spacing_px(), 16777216.0 / du_q24, 0.01);
            } else {
                EXPECT_EQ(fix.spacing_px_q16, INT32_MAX) << du_q24;
            }
        }
    }
}

TEST(Pose, PastTheEndOfTheCodeItContinuesInAnotherSection) {
    // docs/position-code.md: (x + L, y) in section (u, v) is (x, y) in section (u + 52, v + 34).
    const Place place{{kPositionsPerAxis - 2, 5}, {60, 40}};
    Fix fix;
    const auto at = [](Vec2 point) {
        return PlaneFromImage{{}, fixed(point, 16), {1 << 20, 0}, {0, 1 << 20}, {}, 0};
    };
    write_pose(at({3.25, 1.5}), {}, CodeVariant::anoto, place, fix);
    EXPECT_EQ(fix.cell, (Cell{1, 6}));
    EXPECT_EQ(fix.section, (Section{(60 + 52) % 63, (40 + 34) % 63}));
    EXPECT_EQ(fix.x_grid(), 1.25);
    EXPECT_EQ(fix.y_grid(), 6.5);
    write_pose(at({-5.25, 0.5}), {}, CodeVariant::anoto, {{3, 5}, {60, 40}}, fix);
    EXPECT_EQ(fix.cell, (Cell{kPositionsPerAxis - 3, 5}));
    EXPECT_EQ(fix.section, (Section{60 - 52, 40 - 34}));
    EXPECT_EQ(fix.fraction_x_q16, 0.75 * 65536);
}

/// Sums over many fixes: the products of the errors of (x, y, theta), and the reported covariances.
struct Scatter {
    double squares[3][3] = {};
    double claimed[3][3] = {};
    double residual_px = 0;
    int count = 0;

    void add(const std::array<double, 3>& error, const Fix& fix) {
        for (std::size_t r = 0; r < 3; ++r) {
            for (std::size_t c = 0; c < 3; ++c) {
                squares[r][c] += error[r] * error[c];
                claimed[r][c] += static_cast<double>(fix.covariance[r][c]);
                EXPECT_EQ(fix.covariance[r][c], fix.covariance[c][r]);
            }
        }
        residual_px += static_cast<double>(fix.residual_px);
        ++count;
    }
};

/// Fits a pose to the same view `rounds` times, with new noise on all dots each time.
Scatter scatter(const View& view, Vec2 reference, double sigma_px, int rounds, Rng& rng) {
    const auto placed = pattern_dots(view);
    Scatter result;
    for (int i = 0; i < rounds; ++i) {
        const Reading reading(view, {}, noisy_dots(placed, sigma_px, rng));
        const Fitted fit = fitted(reading, reference);
        if (!fit.ok) continue;
        const Vec2 error = error_at(reading, fit.pose, reference);
        const double turned =
            std::remainder(fit.fix.theta_rad() - view.theta_rad, 2 * std::numbers::pi);
        result.add({error.x, error.y, turned}, fit.fix);
    }
    return result;
}

TEST(Pose, CovarianceIsThatOfManyNoisyFrames) {
    constexpr int kRounds = 4000;
    Rng rng(kSeed);
    const View view = random_view(rng);
    for (const Vec2 reference : {view.centre_px(), Vec2{187, 0}, Vec2{-60, 100}}) {
        SCOPED_TRACE(testing::Message()
                     << "reference " << reference.x << ", " << reference.y << ", seed " << kSeed);
        const Scatter found = scatter(view, reference, 0.1, kRounds, rng);
        ASSERT_EQ(found.count, kRounds);
        for (std::size_t r = 0; r < 3; ++r) {
            // The covariance allows for a tilt. Because this view has no tilt, the covariance is
            // too large away from the centre.
            const double ratio = found.claimed[r][r] / found.squares[r][r];
            EXPECT_GT(ratio, 0.85) << r;
            EXPECT_LT(ratio, 1.6) << r;
            for (std::size_t c = 0; c < r; ++c) {
                const double scale = std::sqrt(found.squares[r][r] * found.squares[c][c]);
                EXPECT_NEAR(found.claimed[r][c] / scale, found.squares[r][c] / scale, 0.25)
                    << r << ", " << c;
            }
        }
        EXPECT_NEAR(found.residual_px / found.count, 0.1, 0.002);
    }
}

/// Paper that is light on the left and dark on the right.
struct HalfDark {
    static constexpr int kLight = 240;
    static constexpr int kDark = 60;
    std::array<std::uint8_t, 16 * 10> levels{};
    PaperMap map{12, 16, 10, levels, {}};

    HalfDark() {
        for (std::size_t i = 0; i < levels.size(); ++i)
            levels[i] = i % 16 < 8 ? kLight : kDark;
    }
    static int at(Vec2 pixel) { return pixel.x < 96 ? kLight : kDark; }
};

TEST(Pose, DotsInTheDarkCountLess) {
    // Noise of 0.02 px in the light part corresponds to 0.08 px in the dark part, so the variance
    // of a dot in the dark part is 16 times as large. Compared with a view with all dots in the
    // light part, the variance of the unweighted mean is 8.5 times as large, and that of the
    // weighted mean is 1.9 times as large.
    Rng rng(kSeed);
    const HalfDark paper;
    const View view = random_view(rng);
    const auto placed = pattern_dots(view);
    double squares_alike = 0;
    double squares_weighted = 0;
    double claimed = 0;
    for (int i = 0; i < 1000; ++i) {
        std::vector<DetectedDot> dots;
        for (const PlacedDot& dot : placed) {
            const double sigma_px = 0.02 * HalfDark::kLight / HalfDark::at(dot.centre_px);
            dots.push_back(dot_at(dot.centre_px + sigma_px * Vec2{rng.normal(), rng.normal()}));
        }
        const Reading reading(view, {}, dots);
        const auto squared_error = [&](const Fitted& fit) {
            EXPECT_TRUE(fit.ok);
            const Vec2 error = error_at(reading, fit.pose, view.centre_px());
            return error.x * error.x + error.y * error.y;
        };
        const Fitted weighted = fitted(reading, view.centre_px(), &paper.map);
        squares_alike += squared_error(fitted(reading, view.centre_px()));
        squares_weighted += squared_error(weighted);
        claimed +=
            static_cast<double>(weighted.fix.covariance[0][0] + weighted.fix.covariance[1][1]);
    }
    EXPECT_LT(squares_weighted, 0.7 * squares_alike);
    EXPECT_NEAR(claimed / squares_weighted, 1, 0.2);
}

}  // namespace
}  // namespace dotpose::core_test::pose_test
