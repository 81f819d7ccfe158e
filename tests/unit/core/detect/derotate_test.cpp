// Tests that the rotation during the readout is correctly removed from images and from single
// points. The expected results come from a simulated camera that does not rotate.
#include "core/detect/derotate.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "dotpose/tools/simulate.hpp"

namespace dotpose::core_test {
namespace {

constexpr float kCentreU = 93.5F;
constexpr float kCentreV = 59.5F;

CameraModel turning_camera(double turn_rad, Vec2 readout_px) {
    CameraModel camera;
    camera.readout_turn_rad = turn_rad;
    camera.readout_px = readout_px;
    return camera;
}

core::ReadoutTurn turn_of(const CameraModel& camera) {
    const auto per_row = [&](double value) { return static_cast<float>(value / camera.height_px); };
    return {per_row(camera.readout_turn_rad),
            {},
            {per_row(camera.readout_px.x), per_row(camera.readout_px.y)}};
}

TEST(ReadoutTurn, SeparatesTheRotationFromTheMotion) {
    // Projects each point twice: with motion only, and with motion and rotation.
    const Vec2 motion{20, -12};
    const CameraModel moving = turning_camera(0, motion);
    for (const double turn_rad : {-0.9, 0.05, 0.6}) {
        const CameraModel both = turning_camera(turn_rad, motion);
        for (const Vec2 offset_mm : {Vec2{0, 0}, Vec2{1.5, -1.8}, Vec2{-2.5, 1.1}}) {
            const Vec2 without = Projection(moving, {}).pixel_from_offset(offset_mm);
            const Vec2 with = Projection(both, {}).pixel_from_offset(offset_mm);
            const core::FloatVec seen{static_cast<float>(with.x) - kCentreU,
                                      static_cast<float>(with.y) - kCentreV};
            const core::FloatVec still = turn_of(both).without_turn(seen);
            EXPECT_NEAR(still.x + kCentreU, without.x, 0.03);
            EXPECT_NEAR(still.y + kCentreV, without.y, 0.03);
            const core::FloatVec back = turn_of(both).seen_from(still, still.y, 8);
            EXPECT_NEAR(back.x, seen.x, 1e-3);
            EXPECT_NEAR(back.y, seen.y, 1e-3);
        }
    }
}

TEST(ReadoutTurn, ThePlaneOfASquareGridShowsTheDrift) {
    // A grid with a spacing of 10 px, turned by 30 degrees, in a scene that drifts during the
    // readout. The scene point p appears in the image at p + v drift, where v is the image row. du
    // and dv are the columns of the map from image to grid.
    const float c = std::sqrt(0.75F) / 10;
    const float s = 0.5F / 10;
    const core::FloatVec drift{0.2F, -0.3F};
    core::FloatPlane plane;
    plane.du_x = c;
    plane.du_y = s;
    // The image point (u, v) shows p = (u - drift.x v, v - drift.y v).
    plane.dv_x = -c * drift.x - s * (1 - drift.y);
    plane.dv_y = -s * drift.x + c * (1 - drift.y);
    EXPECT_NEAR(core::drift_of(plane).x, drift.x, 1e-6);
    EXPECT_NEAR(core::drift_of(plane).y, drift.y, 1e-6);
}

TEST(Derotated, IsTheImageOfAStillScene) {
    constexpr int kBorder_px = 40;  // the rotation moves other parts of the scene into this border
    // Maximum mean difference in grey levels. It is small because most pixels are paper in both
    // images.
    constexpr double kMaxMeanDifference = 1;
    dotpose::Setup setup;
    setup.preset = Preset::clean;
    Shot still = draw_shot(setup, 3);
    still.imperfections.blur_sigma_px = 1.2;
    Shot turning = still;
    turning.camera.readout_turn_rad = 20 * std::numbers::pi / 180;
    const GreyImage expected = render(still);
    const GreyImage seen = render(turning);
    std::vector<std::uint8_t> memory(188 * 120);
    const auto mean_difference = [&](const ImageView& image) {
        double sum = 0;
        int count = 0;
        for (int v = kBorder_px / 2; v < 120 - kBorder_px / 2; ++v) {
            for (int u = kBorder_px; u < 188 - kBorder_px; ++u, ++count)
                sum += std::abs(image.row(v)[u] - expected.view().row(v)[u]);
        }
        return sum / count;
    };
    EXPECT_GT(mean_difference(seen.view()), 3 * kMaxMeanDifference);
    EXPECT_LT(mean_difference(core::derotated(seen.view(), turn_of(turning.camera), memory)),
              kMaxMeanDifference);
}

TEST(Derotated, AnImageWithoutRotationIsACopy) {
    dotpose::Setup setup;
    const GreyImage image = render(draw_shot(setup, 1));
    std::vector<std::uint8_t> memory(188 * 120);
    const ImageView copy = core::derotated(image.view(), {}, memory);
    for (int v = 0; v < 119; ++v) {
        for (int u = 0; u < 187; ++u)
            ASSERT_EQ(copy.row(v)[u], image.view().row(v)[u]) << u << ", " << v;
    }
}

}  // namespace
}  // namespace dotpose::core_test
