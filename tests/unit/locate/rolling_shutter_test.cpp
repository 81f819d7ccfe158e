// Tests the first attempt on frames of a rolling shutter, in which the scene moves while the rows
// are read.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shots.hpp"

namespace dotpose::core_test::rolling_shutter_test {
namespace {

constexpr std::uint64_t kSeed = 77;
constexpr int kDirections = 12;
/// The image contains 24 rows of cells if nothing moves, and at least 9 rows with any motion of
/// these tests.
constexpr ShotSize kSize{.spacing_px = 20, .width_px = 640, .height_px = 480};

/// Returns a frame whose scene moves during the readout by `motion` times the height of the image,
/// in one of kDirections directions.
Shot moved_shot(double motion, int direction) {
    Shot shot = shot_of(kSize, kSeed, static_cast<std::uint64_t>(direction));
    const double angle_rad = 2 * std::numbers::pi * (direction + 0.5) / kDirections;
    shot.camera.readout_px = {motion * kSize.height_px * std::cos(angle_rad),
                              motion * kSize.height_px * std::sin(angle_rad)};
    return shot;
}

TEST(RollingShutter, FramesAreLocatedAtTheFirstAttemptForTheMiddleRow) {
    DeviceOptions options;
    options.effort = Effort::once;
    Locator locator(options);
    for (const double motion : {0.1, 0.3, 0.45, 0.6}) {
        int located = 0;
        for (int i = 0; i < kDirections; ++i) {
            const Shot shot = moved_shot(motion, i);
            const Fix fix = locator.locate(render(shot).view());
            if (fix.status != Status::ok) continue;
            ++located;
            EXPECT_TRUE(is_right(fix, shot)) << motion << ", direction " << i;
            // A hundredth of a spacing is 5 um.
            EXPECT_NEAR(fix.x_grid(), x_grid(shot.pose), 0.01) << motion << ", direction " << i;
            EXPECT_NEAR(fix.y_grid(), y_grid(shot.pose), 0.01) << motion << ", direction " << i;
        }
        EXPECT_GE(located, kDirections - 1) << motion;
    }
}

}  // namespace
}  // namespace dotpose::core_test::rolling_shutter_test
