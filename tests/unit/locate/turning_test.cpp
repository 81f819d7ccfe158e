// Tests frames from a rolling-shutter camera in which the scene turns while the rows are read. Some
// tests use single frames, and others use drives in which each frame is predicted from the last
// fix.
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

#include "dotpose/track.hpp"
#include "shots.hpp"

namespace dotpose::core_test::turning_test {
namespace {

constexpr std::uint64_t kSeed = 78;
constexpr double kDegree = std::numbers::pi / 180;
constexpr ShotSize kSmall{.spacing_px = 11, .width_px = 188, .height_px = 120};
constexpr ShotSize kLarge{.spacing_px = 20, .width_px = 640, .height_px = 480};

DeviceOptions once() {
    DeviceOptions options;
    options.effort = Effort::once;
    return options;
}

/// Returns a frame whose scene turns by `turn_deg` during the readout, and moves by `motion` times
/// the height of the image.
Shot turned_shot(const ShotSize& size, double turn_deg, Vec2 motion, int index) {
    Shot shot = shot_of(size, kSeed, static_cast<std::uint64_t>(index));
    shot.camera.readout_turn_rad = turn_deg * kDegree;
    shot.camera.readout_px = {motion.x * size.height_px, motion.y * size.height_px};
    return shot;
}

struct Counts {
    int located = 0;
    /// Sum over all located frames. Each term is a squared error of x or y, divided by its
    /// variance.
    double squares = 0;
};

Counts locate_turned(const ShotSize& size, double turn_deg, Vec2 motion, int frames) {
    Locator locator(once());
    Counts counts;
    for (int i = 0; i < frames; ++i) {
        const Shot shot = turned_shot(size, i % 2 == 0 ? turn_deg : -turn_deg, motion, i);
        const Fix fix = locator.locate(render(shot).view());
        if (fix.status != Status::ok) continue;
        ++counts.located;
        EXPECT_TRUE(is_right(fix, shot)) << turn_deg << ", frame " << i;
        // 0.012 spacings are 6 um.
        const double off_x = fix.x_grid() - x_grid(shot.pose);
        const double off_y = fix.y_grid() - y_grid(shot.pose);
        EXPECT_LT(std::hypot(off_x, off_y), 0.012) << turn_deg << ", frame " << i;
        // The signs are opposite because theta decreases if the scene turns clockwise.
        EXPECT_NEAR(fix.readout_turn_rad, -shot.camera.readout_turn_rad, 0.5 * kDegree) << i;
        counts.squares += off_x * off_x / double{fix.covariance[0][0]} +
                          off_y * off_y / double{fix.covariance[1][1]};
    }
    return counts;
}

TEST(Turning, FramesAreLocatedAtTheFirstAttemptForTheMiddleRow) {
    for (const double turn_deg : {2.0, 10.0, 20.0, 40.0, 60.0}) {
        constexpr int kFrames = 60;
        const Counts counts = locate_turned(kSmall, turn_deg, {}, kFrames);
        EXPECT_GE(counts.located, kFrames * 95 / 100) << turn_deg;
        EXPECT_NEAR(counts.squares / (2 * counts.located), 1, 0.4) << turn_deg;
    }
}

TEST(Turning, LargerFramesAreLocated) {
    constexpr int kFrames = 10;
    for (const double turn_deg : {1.0, 3.0, 20.0, 60.0})
        EXPECT_EQ(locate_turned(kLarge, turn_deg, {}, kFrames).located, kFrames) << turn_deg;
}

TEST(Turning, SmallFramesAreLocated) {
    constexpr ShotSize kSmallest{.spacing_px = 7, .width_px = 88, .height_px = 88};
    constexpr int kFrames = 60;
    for (const double turn_deg : {2.0, 3.0, 5.0, 10.0, 20.0})
        EXPECT_GE(locate_turned(kSmallest, turn_deg, {}, kFrames).located, kFrames * 95 / 100)
            << turn_deg;
}

TEST(Turning, TheSceneMayAlsoMove) {
    constexpr int kFrames = 10;
    EXPECT_EQ(locate_turned(kLarge, 4, {0, -0.6}, kFrames).located, kFrames);
    EXPECT_EQ(locate_turned(kLarge, 20, {0.3, 0.2}, kFrames).located, kFrames);
}

TEST(Turning, AFalseGridDoesNotEndTheSearchOnKnownSheets) {
    constexpr int kFrames = 64;
    constexpr std::uint32_t kReach = 200;
    Locator locator(once());
    int located = 0;
    for (int i = 0; i < kFrames; ++i) {
        const Shot shot = turned_shot(kSmall, i % 2 == 0 ? -20 : 20, {}, i);
        const Cell& cell = shot.pose.cell;
        const std::array sheet{KnownRegion{CodeVariant::anoto,
                                           shot.page.pattern.section,
                                           {cell.x - kReach, cell.y - kReach},
                                           2 * kReach,
                                           2 * kReach}};
        ASSERT_EQ(locator.set_known(sheet), Status::ok);
        const Fix fix = locator.locate(render(shot).view());
        if (fix.status != Status::ok) continue;
        ++located;
        EXPECT_TRUE(is_right(fix, shot)) << i;
    }
    EXPECT_EQ(located, kFrames);
}

TEST(Turning, TheFixOfAStillSceneHasNoTurn) {
    Locator locator(once());
    for (int i = 0; i < 20; ++i) {
        const Fix fix = locator.locate(render(turned_shot(kSmall, 0, {}, i)).view());
        ASSERT_EQ(fix.status, Status::ok);
        EXPECT_EQ(fix.readout_turn_rad, 0);
    }
}

constexpr int kIntervals = 2;  ///< frame interval, in units of the readout time

/// A camera on a robot that drives in a circle.
struct Drive {
    double motion;    ///< motion during the readout, relative to the height of the image
    double turn_deg;  ///< turn of the camera during the readout
};

TEST(Turning, EveryFrameOfADriveIsTracked) {
    for (const Drive drive : {Drive{0.1, 0.5}, {0.3, 0.5}, {0.6, 0.5}, {0.1, 5}, {0, 20}}) {
        Locator locator(DeviceOptions{});
        Tracker tracker;
        const Shot first = turned_shot(kLarge, -drive.turn_deg, {}, 0);
        constexpr int kFrames = 30;
        constexpr int kFresh = 3;  // the tracker needs a few frames to measure the velocity
        Fix last;
        Sighting seen;
        double x = x_grid(first.pose);
        double y = y_grid(first.pose);
        for (int i = 0; i < kFrames; ++i) {
            Shot shot = first;
            shot.seed += static_cast<std::uint64_t>(i);
            const double theta = first.pose.theta_rad + i * kIntervals * drive.turn_deg * kDegree;
            shot.pose.theta_rad = theta;
            shot.pose.cell = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
            shot.pose.fraction_x = x - std::floor(x);
            shot.pose.fraction_y = y - std::floor(y);
            // The camera drives along its x axis, so the scene moves to the left.
            shot.camera.readout_px = {-drive.motion * kLarge.height_px, 0};
            const std::int64_t time_us = std::int64_t{i} * 20'000;
            const GreyImage image = render(shot);
            const Fix fix =
                i < kFresh ? locator.locate(image.view())
                           : locator.locate(image.view(),
                                            tracker.predict(time_us, last, seen, DeviceOptions{}));
            ASSERT_EQ(fix.status, Status::ok) << drive.motion << ", frame " << i;
            EXPECT_TRUE(is_right(fix, shot));
            if (i >= kFresh) {
                EXPECT_EQ(fix.attempt, Attempt::tracked) << drive.motion << ", frame " << i;
            }
            last = fix;
            seen = sighting_of(fix, time_us);
            tracker.update(time_us, &seen);
            const double step = kIntervals * drive.motion * kLarge.height_px / kLarge.spacing_px;
            const double along = theta + kIntervals * drive.turn_deg * kDegree / 2;
            x += step * std::cos(along);
            y += step * std::sin(along);
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test::turning_test
