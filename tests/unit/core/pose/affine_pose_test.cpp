// The pose in integers against a camera whose geometry is known.
#include "core/pose/affine_pose.hpp"

#include <gtest/gtest.h>

#include "../reading.hpp"
#include "core/pose/subgrid.hpp"

namespace dotpose::core_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 53;
constexpr std::array kProfiles{Profile::anoto, Profile::published, Profile::microdots};

struct Fitted {
    int dots_used = 0;
    PlaneFromImage pose;
};

Fitted fitted(const Reading& reading) {
    const Nominal nominal(reading.grid(), reading.view.profile, reading.truth());
    const Observations observations(reading.dots, reading.grid(), nominal);
    Fitted result;
    result.pose = upright_plane(reading.plane, reading.turn);
    result.dots_used = fit_affine_pose(observations, result.pose);
    return result;
}

/// The pose at the image centre is right, in value and slope.
void expect_pose(const Reading& reading, const PlaneFromImage& found, double tolerance) {
    const View& view = reading.view;
    const Vec2 zero{static_cast<double>(reading.zero.x), static_cast<double>(reading.zero.y)};
    const Vec2 expected = view.pattern(view.centre_px()) - zero;
    const Vec2 at = real(plane_point_q16(found, fixed(view.centre_px(), 8)), 16);
    EXPECT_NEAR(at.x, expected.x, tolerance);
    EXPECT_NEAR(at.y, expected.y, tolerance);
    // Directions err by as much over half the image as positions do.
    const double slope = 2 * tolerance / view.image_px.y;
    EXPECT_NEAR(real(found.du_q24, 24).x, view.du().x, slope);
    EXPECT_NEAR(real(found.du_q24, 24).y, view.du().y, slope);
    EXPECT_NEAR(real(found.dv_q24, 24).x, view.dv().x, slope);
    EXPECT_NEAR(real(found.dv_q24, 24).y, view.dv().y, slope);
    EXPECT_TRUE(is_affine(found));
}

/// Dots are taken in 1/8 px, which scatters each by 0.036 px: 100 of them or more at 6 px or more,
/// at four times the deviation, and what rounding leaves.
constexpr double kExact = 4 * 0.036 / 10 / 6 + 1e-4;

TEST(AffinePose, FittedToExactDotsIsExact) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        View view = random_view(rng);
        view.spacing_px = rng.uniform(6, 11);
        view.profile = kProfiles[static_cast<std::size_t>(i % 3)];
        Reading reading(view, Turn{i % 4});
        // The grid may be off a little: that must not matter.
        reading.plane.at_centre_q16.x += 2000;
        reading.plane.du_q24.y += 3000;
        const Fitted fit = fitted(reading);
        expect_pose(reading, fit.pose, kExact);
        EXPECT_GE(fit.dots_used, static_cast<int>(reading.dots.size()) * 9 / 10);
    }
}

TEST(AffinePose, OutliersAreLeftOut) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        const View view = random_view(rng);
        auto dots = dots_of(pattern_dots(view));
        int moved_dots = 0;
        for (std::size_t d = 0; d < dots.size(); d += 8) {
            const double angle = rng.uniform(0, 6.3);
            const double away_px = rng.uniform(0.7, 2);
            dots[d] = dot_at(real(dots[d].centre_q8, 8) +
                             away_px * Vec2{std::cos(angle), std::sin(angle)});
            ++moved_dots;
        }
        const Reading reading(view, Turn{i % 4}, dots);
        const Fitted fit = fitted(reading);
        expect_pose(reading, fit.pose, kExact);
        EXPECT_LE(fit.dots_used, static_cast<int>(dots.size()) - moved_dots);
        EXPECT_GE(fit.dots_used, static_cast<int>(dots.size()) * 3 / 4);
    }
}

TEST(AffinePose, ADisplacementOtherThanASixthIsMeasured) {
    Rng rng(kSeed);
    for (int i = 0; i < 40; ++i) {
        for (const double displacement : {0.11, 0.14, 0.2, 0.23}) {
            SCOPED_TRACE(testing::Message() << "view " << i << ", displacement " << displacement
                                            << ", seed " << kSeed);
            const View view = random_view(rng);
            std::vector<Dot> dots;
            for (const PlacedDot& d : pattern_dots(view)) {
                const Vec2 own = view.mesh().at(d.cell.x, d.cell.y);
                dots.push_back(dot_at(own + 6 * displacement * (d.centre_px - own)));
            }
            const Reading reading(view, Turn{1}, dots);
            const Fitted fit = fitted(reading);
            expect_pose(reading, fit.pose, 2 * kExact);
            EXPECT_GE(fit.dots_used, static_cast<int>(dots.size()) * 9 / 10);
        }
    }
}

TEST(AffinePose, ScatterAveragesOut) {
    // Dots scattered by 0.2 px per axis: the mean of n is off by 0.2 / sqrt(n).
    Rng rng(kSeed);
    double squares = 0;
    double expected = 0;
    constexpr int kViews = 200;
    for (int i = 0; i < kViews; ++i) {
        const View view = random_view(rng);
        std::vector<Dot> dots;
        for (const PlacedDot& d : pattern_dots(view))
            dots.push_back(dot_at(d.centre_px + 0.2 * Vec2{rng.normal(), rng.normal()}));
        const Reading reading(view, Turn{i % 4}, dots);
        const Fitted fit = fitted(reading);
        const Vec2 zero{static_cast<double>(reading.zero.x), static_cast<double>(reading.zero.y)};
        const Vec2 error = real(plane_point_q16(fit.pose, fixed(view.centre_px(), 8)), 16) -
                           (view.pattern(view.centre_px()) - zero);
        squares += error.x * error.x + error.y * error.y;
        const double per_axis = 0.2 / view.spacing_px;
        expected += 2 * per_axis * per_axis / static_cast<double>(dots.size());
    }
    // 400 errors tell their deviation to 4 %; one dot in some thousand is left out.
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
}  // namespace dotpose::core_test
