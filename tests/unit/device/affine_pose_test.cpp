// Compares the pose computed in integer arithmetic with the true pose of a camera of known
// geometry.
#include "device/affine_pose.hpp"

#include <gtest/gtest.h>

#include "../core/pose/poses.hpp"
#include "core/pose/subgrid.hpp"

namespace dotpose::core_test::affine_pose_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 53;

struct Fitted {
    int dots_used = 0;
    PlaneFromImage pose;
};

Fitted fitted(const Reading& reading) {
    const Nominal nominal(reading.grid(), reading.view.code, reading.truth());
    const Observations observations(reading.dots, reading.grid(), nominal);
    Fitted result;
    result.pose = upright_plane(reading.plane, reading.turn);
    std::int32_t displacement_q16 = 0;
    result.dots_used = fit_affine_pose(observations, result.pose, displacement_q16);
    return result;
}

void expect_affine_pose(const Reading& reading, const PlaneFromImage& found, double tolerance) {
    expect_pose(reading, found, reading.view.centre_px(), tolerance);
    EXPECT_TRUE(is_affine(found));
}

/// Tolerance in spacings. Rounding to 1/8 px gives each dot an error of 0.036 px rms. A view has at
/// least 100 dots, with a spacing of at least 6 px. The tolerance is four standard deviations of
/// the mean error of 100 dots, plus a margin for other rounding errors.
constexpr double kExact = 4 * 0.036 / 10 / 6 + 1e-4;

TEST(AffinePose, FittedToExactDotsIsExact) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        const Reading reading = reading_off_grid(i, rng);
        const Fitted fit = fitted(reading);
        expect_affine_pose(reading, fit.pose, kExact);
        EXPECT_GE(fit.dots_used, static_cast<int>(reading.dots.size()) * 9 / 10);
    }
}

TEST(AffinePose, OutliersAreLeftOut) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        const View view = random_view(rng);
        const Reading reading(view, QuarterTurn{i % 4}, dots_with_outliers(view, 0.7, rng));
        const Fitted fit = fitted(reading);
        expect_affine_pose(reading, fit.pose, kExact);
        const auto dots = static_cast<int>(reading.dots.size());
        EXPECT_LE(fit.dots_used, dots * 7 / 8);
        EXPECT_GE(fit.dots_used, dots * 3 / 4);
    }
}

TEST(AffinePose, ADisplacementOtherThanASixthIsMeasured) {
    Rng rng(kSeed);
    for (int i = 0; i < 40; ++i) {
        for (const double displacement : {0.11, 0.14, 0.2, 0.23}) {
            SCOPED_TRACE(testing::Message() << "view " << i << ", displacement " << displacement
                                            << ", seed " << kSeed);
            const View view = random_view(rng);
            const Reading reading(view, QuarterTurn{1}, dots_displaced_by(displacement, view));
            const Fitted fit = fitted(reading);
            expect_affine_pose(reading, fit.pose, 2 * kExact);
            EXPECT_GE(fit.dots_used, static_cast<int>(reading.dots.size()) * 9 / 10);
        }
    }
}

TEST(AffinePose, ScatterAveragesOut) {
    // Dots scatter by 0.2 px per axis, so the mean of n dots has an error of 0.2 / sqrt(n).
    Rng rng(kSeed);
    double squares = 0;
    double expected = 0;
    constexpr int kViews = 200;
    for (int i = 0; i < kViews; ++i) {
        const View view = random_view(rng);
        const Reading reading(view, QuarterTurn{i % 4}, noisy_dots(pattern_dots(view), 0.2, rng));
        const Vec2 error = error_at(reading, fitted(reading).pose, view.centre_px());
        squares += error.x * error.x + error.y * error.y;
        const double per_axis = 0.2 / view.spacing_px;
        expected += 2 * per_axis * per_axis / static_cast<double>(reading.dots.size());
    }
    // The mean square of 400 errors has a relative standard deviation of 7 %. The limits are wider
    // because the fit also omits about one dot in a thousand.
    EXPECT_LT(squares, 1.25 * expected) << "seed " << kSeed;
    EXPECT_GT(squares, 0.75 * expected) << "seed " << kSeed;
}

TEST(AffinePose, DotsOnOneLineDetermineNone) {
    Rng rng(kSeed);
    Reading reading(random_view(rng), {});
    const int j = reading.grid().j0 + reading.grid().rows / 2;
    for (int row = reading.grid().j0; row < reading.grid().j0 + reading.grid().rows; ++row) {
        for (int i = reading.grid().i0; i < reading.grid().i0 + reading.grid().columns; ++i) {
            if (row != j) reading.grid().at(i, row) = {};
        }
    }
    const Fitted fit = fitted(reading);
    EXPECT_EQ(fit.dots_used, 0);
    EXPECT_EQ(fit.pose.at_centre_q16, upright_plane(reading.plane, reading.turn).at_centre_q16);
    EXPECT_EQ(fit.pose.du_q24, upright_plane(reading.plane, reading.turn).du_q24);
}

}  // namespace
}  // namespace dotpose::core_test::affine_pose_test
