// Tests how photos are distinguished from scans by the geometry of the page. The geometry is
// computed independently of the code under test.
#include "calibrate/print_view.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace dotpose::calibrate {
namespace {

constexpr double kLongerSide_px = 4000;
const Eigen::Vector2d kMiddle_px(1999.5, 1499.5);

/// Returns the dots in a photo of a 240 x 180 mm page, which has 3 dots per cm. The camera has a
/// focal length of 3000 px and is 260 mm from the page. It is tilted by `tilt` about an axis in the
/// plane of the page. `azimuth` is the direction of this axis. The print is (1 + `wide`) times as
/// wide as nominal.
std::vector<Match> photo(double tilt, double azimuth, double wide) {
    std::vector<Match> matches;
    for (double x_mm = -120; x_mm <= 120; x_mm += 10.0 / 3) {
        for (double y_mm = -90; y_mm <= 90; y_mm += 10.0 / 3) {
            const double x = (1 + wide) * x_mm;
            const double along = x * std::cos(azimuth) + y_mm * std::sin(azimuth);
            const double across = y_mm * std::cos(azimuth) - x * std::sin(azimuth);
            const double depth_mm = 260 + across * std::sin(tilt);
            const Eigen::Vector2d seen(along, across * std::cos(tilt));
            matches.push_back({{x_mm, y_mm}, kMiddle_px + 3000 / depth_mm * seen});
        }
    }
    return matches;
}

constexpr double kDegree = std::numbers::pi / 180;

TEST(PrintView, tells_cameras_from_scanners) {
    EXPECT_FALSE(signs_of_camera(photo(0, 0, 0.03), kMiddle_px));
    for (const double tilt : {0.5, 1.0, 10.0, 25.0}) {
        const auto signs = signs_of_camera(photo(tilt * kDegree, 0, 0), kMiddle_px);
        ASSERT_TRUE(signs) << tilt;
        // The far end of the page is 180 mm * sin(tilt) farther from the camera than the near end.
        // The perspective is this difference, relative to the distance of 260 mm.
        EXPECT_NEAR(signs->perspective, 180 * std::sin(tilt * kDegree) / 260, 1e-6);
        EXPECT_NEAR(signs->lens, 0, 1e-6);
    }
    std::vector<Match> bent = photo(0, 0, 0);
    for (Match& match : bent) {
        const Eigen::Vector2d q = match.seen - kMiddle_px;
        match.seen += 0.01 * q.squaredNorm() / (1750.0 * 1750.0) * q;
    }
    ASSERT_TRUE(signs_of_camera(bent, kMiddle_px));
    EXPECT_NEAR(signs_of_camera(bent, kMiddle_px)->perspective, 0, 1e-6);
}

TEST(PrintView, a_scanner_whose_carriage_runs_unevenly_is_no_camera) {
    std::vector<Match> scan = photo(0, 0, 0);
    for (Match& match : scan)
        match.seen.y() += 6 * std::sin(match.seen.y() / 400);
    EXPECT_FALSE(signs_of_camera(scan, kMiddle_px));
}

TEST(PrintView, tells_the_ratio_of_the_scales_as_far_as_it_is_known) {
    for (const double wide : {0.0, 0.006, -0.01}) {
        for (const double tilt : {0.0, 1.0, 20.0}) {
            const PlaneFit fit =
                fit_plane(photo(tilt * kDegree, 0.7, wide), ViewModel::camera, kMiddle_px);
            const auto ratio = scale_ratio_of(fit, kLongerSide_px);
            ASSERT_TRUE(ratio) << tilt;
            EXPECT_NEAR(ratio->x_over_y, 1 + wide, ratio->uncertainty) << tilt;
            EXPECT_LT(ratio->uncertainty, 0.006) << tilt;
        }
    }
    // The foreshortening caused by a tilt about an axis of the paper looks like different scales
    // along x and y.
    const PlaneFit fit = fit_plane(photo(20 * kDegree, 0, 0), ViewModel::camera, kMiddle_px);
    EXPECT_FALSE(scale_ratio_of(fit, kLongerSide_px));
}

}  // namespace
}  // namespace dotpose::calibrate
