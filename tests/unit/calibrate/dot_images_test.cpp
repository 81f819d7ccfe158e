// Tests the measurement of dots at expected positions. The true centres come from the simulator's
// projection.
#include "calibrate/dot_images.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "dotpose/tools/simulate.hpp"

namespace dotpose {
namespace {

/// A frame, the true positions of its dots, and expected positions with errors of a fraction of a
/// pixel.
struct Frame {
    GreyImage image;
    std::vector<Eigen::Vector2d> truth;
    std::vector<calibrate::ExpectedDot> expected;
};

Frame frame_of(const Shot& shot) {
    constexpr int kReach = 20;
    Frame frame;
    frame.image = render(shot);
    const Projection projection(shot.camera, shot.pose);
    const double mm = shot.page.pattern.spacing_mm;
    for (int j = -kReach; j <= kReach; ++j) {
        for (int i = -kReach; i <= kReach; ++i) {
            const Place place =
                moved(shot.page.pattern.code, {shot.pose.cell, shot.page.pattern.section}, i, j);
            const Symbol symbol = symbol_at(shot.page.pattern.code, place.cell, place.section);
            const auto pixel = [&](double dx_mm, double dy_mm) {
                const Vec2 p = projection.pixel_from_offset(
                    {(i - shot.pose.fraction_x + dx(symbol) / 6.0) * mm + dx_mm,
                     (j - shot.pose.fraction_y + dy(symbol) / 6.0) * mm + dy_mm});
                return Eigen::Vector2d(p.x, p.y);
            };
            calibrate::ExpectedDot dot;
            dot.pixel = pixel(0, 0) + Eigen::Vector2d(0.3, -0.2);
            dot.px_per_spacing.col(0) = pixel(mm / 2, 0) - pixel(-mm / 2, 0);
            dot.px_per_spacing.col(1) = pixel(0, mm / 2) - pixel(0, -mm / 2);
            if (!calibrate::is_measurable(frame.image.view(), dot)) continue;
            frame.truth.push_back(pixel(0, 0));
            frame.expected.push_back(dot);
        }
    }
    return frame;
}

Shot clean_shot(double tilt_rad) {
    Setup setup;
    setup.preset = Preset::clean;
    setup.camera.width_px = 240;
    setup.camera.height_px = 160;
    setup.camera.working_distance_mm = 25;
    setup.seed = 7;
    Shot shot = draw_shot(setup, 0);
    shot.pose.tilt_x_rad = tilt_rad;
    shot.imperfections.blur_sigma_px = 0.6;
    return shot;
}

TEST(DotImages, MeasuresAllDotsAlsoAtTheBorder) {
    for (const double tilt_rad : {0.0, 0.6}) {
        for (const double fall : {0.0, 0.3}) {
            Shot shot = clean_shot(tilt_rad);
            shot.imperfections.fall = fall;
            shot.imperfections.fall_direction_rad = 1;
            const Frame frame = frame_of(shot);
            const auto centres = measured_centres(frame.image.view(), frame.expected);
            ASSERT_GT(centres.size(), 200U);
            Eigen::Vector2d mean = Eigen::Vector2d::Zero();
            for (std::size_t i = 0; i < centres.size(); ++i) {
                ASSERT_TRUE(centres[i]) << frame.truth[i].transpose();
                const Eigen::Vector2d error = centres[i]->pixel - frame.truth[i];
                EXPECT_LT(error.norm(), 0.08) << frame.truth[i].transpose();
                mean += error / static_cast<double>(centres.size());
            }
            EXPECT_LT(mean.norm(), 0.004) << "tilt " << tilt_rad << ", fall " << fall;
        }
    }
}

TEST(DotImages, HaveTrueCovariances) {
    Shot shot = clean_shot(0.5);
    shot.imperfections.noise_sigma = 4;
    const Frame frame = frame_of(shot);
    const auto centres = measured_centres(frame.image.view(), frame.expected);
    double normalised = 0;
    for (std::size_t i = 0; i < centres.size(); ++i) {
        ASSERT_TRUE(centres[i]);
        const Eigen::Vector2d error = centres[i]->pixel - frame.truth[i];
        normalised += error.dot(centres[i]->covariance.inverse() * error) / (4 * 4) /
                      (2 * static_cast<double>(centres.size()));
    }
    EXPECT_NEAR(normalised, 1, 0.25);
}

TEST(DotImages, OmitMissingDots) {
    Shot shot = clean_shot(0);
    shot.imperfections.missing = 0.2;
    shot.imperfections.noise_sigma = 2;
    const Frame frame = frame_of(shot);
    const auto centres = measured_centres(frame.image.view(), frame.expected);
    std::size_t found = 0;
    for (std::size_t i = 0; i < centres.size(); ++i) {
        if (!centres[i]) continue;
        ++found;
        EXPECT_LT((centres[i]->pixel - frame.truth[i]).norm(), 0.3);
    }
    EXPECT_GT(found, centres.size() * 70 / 100);
    EXPECT_LT(found, centres.size() * 90 / 100);
}

TEST(DotImages, AreNotMeasurableOutsideTheImageOrTooSmall) {
    const GreyImage image{{}, 100, 80};
    const auto is_measurable = [&](double u, double v, double spacing_px) {
        return calibrate::is_measurable(image.view(),
                                        {{u, v}, spacing_px * Eigen::Matrix2d::Identity()});
    };
    EXPECT_TRUE(is_measurable(50, 40, 10));
    EXPECT_FALSE(is_measurable(50, 40, 3));
    EXPECT_TRUE(is_measurable(1.5, 40, 10));
    EXPECT_FALSE(is_measurable(0.5, 40, 10));
    EXPECT_FALSE(is_measurable(50, 79, 10));
}

}  // namespace
}  // namespace dotpose
