// Tests the coverage of a calibration: which requirements have not been met yet, and how uncertain
// the lens distortion is in the corner of the image.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/calibration_coverage.hpp"
#include "frames.hpp"

namespace dotpose {
namespace {

using namespace calibrate_test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = CalibrationNeed::Kind;

/// Image size. The image consists of 12 x 8 parts, each of 10 x 10 px.
constexpr int kWidth_px = 120;
constexpr int kHeight_px = 80;

std::vector<Kind> kinds(const std::vector<CalibrationNeed>& needs) {
    std::vector<Kind> all;
    for (const CalibrationNeed& need : needs)
        all.push_back(need.kind);
    return all;
}

/// Returns a frame at the grid position (`x_grid`, `y_grid`), with a spacing of 10 px. The frame
/// has one dot in the middle of each part of the image, except in the parts listed in `empty`.
CalibrationView view_at(double x_grid, double y_grid, double theta_deg,
                        const std::vector<std::pair<int, int>>& empty = {}) {
    CalibrationView view;
    view.x_grid = x_grid;
    view.y_grid = y_grid;
    view.theta_rad = theta_deg * kDegree_rad;
    view.spacing_px = 10;
    for (int row = 0; row < ImageCoverage::kRows; ++row) {
        for (int column = 0; column < ImageCoverage::kColumns; ++column) {
            if (std::ranges::find(empty, std::pair(column, row)) != empty.end()) continue;
            view.dots.push_back({10.0 * column + 4.5, 10.0 * row + 4.5});
        }
    }
    return view;
}

/// Returns a camera whose lens distortion has a standard deviation of `sigma_px` in the image
/// corner. Only k is uncertain.
Camera lens_known_to(double sigma_px) {
    Camera camera;
    camera.width_px = kWidth_px;
    camera.height_px = kHeight_px;
    camera.centre_px = {59.5, 39.5};
    const double r_px = std::hypot(59.5, 39.5);
    camera.sigma = {
        {"k_per_px2", sigma_px / std::pow(r_px, 3)}, {"centre_u_px", 0}, {"centre_v_px", 0}};
    return camera;
}

TEST(ImageCoverage, MarksThePartThatAPixelLiesIn) {
    ImageCoverage image(kWidth_px, kHeight_px);
    EXPECT_EQ(image.fraction(), 0);
    // Pixel 9 is the last pixel of the first part. The right border of this pixel is at 9.5.
    EXPECT_TRUE(image.add({9.4, 0}));
    EXPECT_FALSE(image.add({0, 9.4}));
    EXPECT_TRUE(image.add({9.6, 0}));
    EXPECT_TRUE(image.add({119.4, 79.4}));
    EXPECT_FALSE(image.add({119.6, 0}));
    EXPECT_FALSE(image.add({0, 79.6}));
    EXPECT_TRUE(image.is_covered(0, 0));
    EXPECT_TRUE(image.is_covered(1, 0));
    EXPECT_TRUE(image.is_covered(11, 7));
    EXPECT_FALSE(image.is_covered(0, 1));
    EXPECT_DOUBLE_EQ(image.fraction(), 3.0 / 96);
}

TEST(CalibrationCoverage, CountsPlacesDirectionsAndNewParts) {
    CalibrationCoverage coverage(kWidth_px, kHeight_px);
    EXPECT_EQ(coverage.parts_added_by(view_at(0, 0, 0, {{3, 4}})), 95);
    coverage.add(view_at(0, 0, 0, {{3, 4}}));
    EXPECT_EQ(coverage.parts_added_by(view_at(0, 0, 0)), 1);
    // A frame shows a new place if its distance from the earlier frames is at least a quarter of
    // the shorter side of the image. This side is 8 spacings long, so the minimum distance is 2
    // spacings.
    coverage.add(view_at(1.9, 0, 44));
    EXPECT_EQ(coverage.places(), 1);
    EXPECT_EQ(coverage.directions(), 1);
    coverage.add(view_at(0, 2.1, 46));
    EXPECT_EQ(coverage.places(), 2);
    coverage.add(view_at(0, 0, -1));
    EXPECT_EQ(coverage.places(), 2);
    EXPECT_EQ(coverage.directions(), 3);
    EXPECT_TRUE(coverage.has_direction(0));
    EXPECT_TRUE(coverage.has_direction(1));
    EXPECT_TRUE(coverage.has_direction(7));
    EXPECT_FALSE(coverage.has_direction(4));
    // This frame shows the same place as an earlier frame, but in another section.
    CalibrationView other = view_at(0, 0, 0);
    other.section = {1, 0};
    coverage.add(other);
    EXPECT_EQ(coverage.places(), 3);
    EXPECT_EQ(coverage.frames(), 5);
}

TEST(CalibrationCoverage, SaysWhatIsMissingUntilNothingIs) {
    CalibrationCoverage coverage(kWidth_px, kHeight_px);
    EXPECT_THAT(kinds(coverage.missing(std::nullopt)), ElementsAre(Kind::frames));
    coverage.add(view_at(0, 0, 10));
    EXPECT_THAT(kinds(coverage.missing(std::nullopt)),
                ElementsAre(Kind::places, Kind::directions, Kind::frames));
    coverage.add(view_at(5, 0, 100));
    coverage.add(view_at(10, 0, 190));
    EXPECT_THAT(kinds(coverage.missing(std::nullopt)), ElementsAre(Kind::places, Kind::frames));
    coverage.add(view_at(15, 0, 190));
    coverage.add(view_at(15, 0, 190));
    EXPECT_THAT(kinds(coverage.missing(std::nullopt)), ElementsAre(Kind::lens));
    const auto needs = coverage.missing(lens_known_to(0.2));
    ASSERT_THAT(kinds(needs), ElementsAre(Kind::lens));
    EXPECT_THAT(needs[0].advice, HasSubstr("uncertainty in the corner 0.200 px"));
    EXPECT_THAT(coverage.missing(lens_known_to(0.09)), IsEmpty());
}

TEST(CalibrationCoverage, NamesThePartOfTheImageThatIsMissing) {
    const std::vector<std::pair<int, int>> corner = {{0, 5}, {1, 5}, {2, 5}, {0, 6}, {1, 6},
                                                     {2, 6}, {0, 7}, {1, 7}, {2, 7}};
    CalibrationCoverage coverage(kWidth_px, kHeight_px);
    coverage.add(view_at(0, 0, 0, corner));
    // The dots cover more than the required fraction of the image, but one corner has no dots.
    ASSERT_GT(coverage.image().fraction(), kMinCoverage);
    const auto needs = coverage.missing(std::nullopt);
    ASSERT_EQ(needs[0].kind, Kind::image);
    EXPECT_THAT(needs[0].advice, HasSubstr("lower left corner"));
}

TEST(CornerSigma, IsThatOfTheDivisionModel) {
    Camera camera;
    camera.width_px = 188;
    camera.height_px = 120;
    camera.k_per_px2 = -8.7e-6;
    camera.centre_px = {94, 59};  // the corner at (0, 119) is the farthest from this centre
    const double x = -94;
    const double y = 60;
    const double d = 1 + camera.k_per_px2 * (x * x + y * y);
    camera.sigma = {{"k_per_px2", 2e-8}, {"centre_u_px", 0}, {"centre_v_px", 0}};
    // With p = r / (1 + k r^2) (paper, equation 2), dp/dk is -r r^2 / (1 + k r^2)^2.
    // `corner_sigma_px` also subtracts the derivative at the middle of the image, which is zero to
    // eight digits here.
    const double by_k = std::pow(std::hypot(x, y), 3) / (d * d) * 2e-8;
    EXPECT_NEAR(corner_sigma_px(camera), by_k, 1e-5 * by_k);

    camera.sigma = {{"k_per_px2", 0}, {"centre_u_px", 0.2}, {"centre_v_px", 0}};
    // With the centre c, equation 2 is p = c + q / (1 + k q^2), where q = r - c.
    const double along = 1 - 1 / d + 2 * camera.k_per_px2 * x * x / (d * d);
    const double across = 2 * camera.k_per_px2 * x * y / (d * d);
    const double by_centre = std::hypot(along, across) * 0.2;
    EXPECT_NEAR(corner_sigma_px(camera), by_centre, 1e-3 * by_centre);

    camera.sigma = {{"k_per_px2", 2e-8}, {"centre_u_px", 0.2}, {"centre_v_px", 0}};
    EXPECT_NEAR(corner_sigma_px(camera), std::hypot(by_k, by_centre), 1e-3 * by_centre);
}

TEST(CornerSigma, IsTheErrorOfACalibration) {
    const CameraModel camera = paper_camera();
    const auto frame_at = [&camera](int index) { return nominal_frame(camera, 31, index); };
    const LensCalibration found = calibrate_lens(20, frame_at, {});
    const double sigma_px = corner_sigma_px(found.camera);
    EXPECT_GT(sigma_px, 0.02);
    EXPECT_LT(sigma_px, kWantedCornerSigma_px);
    const Camera truth = true_camera(camera);
    const PixelPoint corner = farthest_corner(found.camera);
    const PixelPoint middle{(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
    const auto from_middle = [&](const Camera& by) {
        const PixelPoint a = undistorted(by, corner);
        const PixelPoint b = undistorted(by, middle);
        return Vec2{a.u - b.u, a.v - b.v};
    };
    const Vec2 is = from_middle(found.camera);
    const Vec2 should_be = from_middle(truth);
    EXPECT_LT(std::hypot(is.x - should_be.x, is.y - should_be.y), 4 * sigma_px);
}

}  // namespace
}  // namespace dotpose
