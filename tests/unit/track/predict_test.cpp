// Tests the tracker's predictions of the pattern in the next frame.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "dotpose/track.hpp"

namespace dotpose::predict_test {
namespace {

constexpr std::int64_t kFrame_us = 5000;
constexpr std::int32_t kSpacing_nm = 508'000;
constexpr double kPi = std::numbers::pi;

std::int32_t bam(double angle_rad) {
    return static_cast<std::int32_t>(
        static_cast<std::int64_t>(std::llround(angle_rad / kPi * 2147483648.0)) & 0xFFFFFFFF);
}

/// Pose in the pattern frame, in spacings and rad. `theta_rad` is the angle from +x towards +y,
/// with y down.
struct Pose {
    double x = 0;
    double y = 0;
    double theta_rad = 0;
};

/// Returns the fix that `locate` returns for an image of 188 x 120 px with 11 px per spacing.
Fix fix_at(const Pose& pose) {
    constexpr double kSpacing_px = 11;
    Fix fix;
    fix.status = Status::ok;
    fix.cell = {static_cast<std::uint32_t>(pose.x), static_cast<std::uint32_t>(pose.y)};
    fix.fraction_x_q16 = static_cast<std::uint16_t>(std::lround((pose.x - fix.cell.x) * 65535));
    fix.fraction_y_q16 = static_cast<std::uint16_t>(std::lround((pose.y - fix.cell.y) * 65535));
    fix.theta_bam = bam(pose.theta_rad);
    fix.p_wrong_log2 = -60;
    fix.covariance[0][0] = fix.covariance[1][1] = 1e-6F;
    fix.covariance[2][2] = 1e-8F;
    fix.place = {fix.cell, {}};
    const auto q24 = [](double v) { return static_cast<std::int32_t>(std::lround(v * 16777216)); };
    const double c = std::cos(pose.theta_rad) / kSpacing_px;
    const double s = std::sin(pose.theta_rad) / kSpacing_px;
    PlaneFromImage& plane = fix.pattern_from_image;
    plane.centre_q8 = {93 * 256 + 128, 59 * 256 + 128};
    plane.at_centre_q16 = {fix.fraction_x_q16, fix.fraction_y_q16};
    plane.du_q24 = {q24(c), q24(s)};
    plane.dv_q24 = {q24(-s), q24(c)};
    fix.displacement_q16 = 65536 / 6;
    return fix;
}

/// Returns the pose of the image centre, or of the point at an offset of (dx_px, dy_px) from it.
Pose pose_of(const Prediction& prediction, double dx_px = 0, double dy_px = 0) {
    const PlaneFromImage& plane = prediction.pattern_from_image;
    const auto at = [&](std::uint32_t cell, std::int32_t centre_q16, std::int32_t du,
                        std::int32_t dv) {
        return cell + centre_q16 / 65536.0 + (du * dx_px + dv * dy_px) / 16777216.0;
    };
    return {at(prediction.place.cell.x, plane.at_centre_q16.x, plane.du_q24.x, plane.dv_q24.x),
            at(prediction.place.cell.y, plane.at_centre_q16.y, plane.du_q24.y, plane.dv_q24.y),
            std::atan2(plane.du_q24.y, plane.du_q24.x)};
}

/// Returns the pose of a robot that drives at 300 mm/s along a straight line at 30 degrees while
/// turning at 3 rad/s.
Pose driving(std::int64_t time_us) {
    const double t = static_cast<double>(time_us) * 1e-6;
    const double driven = 300 / 0.508 * t;
    return {5000 + driven * std::cos(kPi / 6), 7000 + driven * std::sin(kPi / 6), 0.4 + 3 * t};
}

/// Returns the sighting of a pose in a world with y up. The x axis of the world is the x axis of
/// the pattern, rotated by 2 rad.
Sighting in_world(const Pose& pose, std::int64_t time_us) {
    constexpr double kYaw_rad = 2;
    Sighting sighting = sighting_of(fix_at(pose), time_us);
    const double c = std::cos(kYaw_rad);
    const double s = std::sin(kYaw_rad);
    const double x = pose.x * kSpacing_nm;
    const double y = -pose.y * kSpacing_nm;
    sighting.x_nm = std::llround(c * x - s * y);
    sighting.y_nm = std::llround(s * x + c * y);
    sighting.theta_bam = bam(kYaw_rad - pose.theta_rad);
    sighting.is_y_up = true;
    return sighting;
}

struct Followed {
    Tracker tracker;
    Fix fix;
    Sighting sighting;

    void see(const Pose& pose, std::int64_t time_us, bool is_world = false) {
        fix = fix_at(pose);
        sighting = is_world ? in_world(pose, time_us) : sighting_of(fix, time_us);
        tracker.update(time_us, &sighting);
    }
    Prediction predict(std::int64_t time_us, const DeviceOptions& options = {}) const {
        return tracker.predict(time_us, fix, sighting, options);
    }
};

/// Tracks the robot along a path up to and including `end_us`.
Followed drive(std::int64_t end_us, Pose (*path)(std::int64_t), bool is_world = false) {
    Followed robot;
    for (std::int64_t t = 0; t <= end_us; t += kFrame_us)
        robot.see(path(t), t, is_world);
    return robot;
}

void expect_near(const Pose& found, const Pose& expected, double spacings, double angle_rad) {
    EXPECT_NEAR(found.x, expected.x, spacings);
    EXPECT_NEAR(found.y, expected.y, spacings);
    EXPECT_NEAR(std::remainder(found.theta_rad - expected.theta_rad, 2 * kPi), 0, angle_rad);
}

void expect_as_seen(const Prediction& prediction, const Fix& fix) {
    const Prediction as_seen = Prediction::like(fix);
    EXPECT_EQ(prediction.place, as_seen.place);
    EXPECT_EQ(prediction.pattern_from_image.at_centre_q16,
              as_seen.pattern_from_image.at_centre_q16);
    EXPECT_EQ(prediction.pattern_from_image.du_q24, as_seen.pattern_from_image.du_q24);
    EXPECT_EQ(prediction.sigma_q16, as_seen.sigma_q16);
    EXPECT_EQ(prediction.sigma_theta_bam, as_seen.sigma_theta_bam);
}

TEST(TrackerPredict, GoesOnStraightAndTurning) {
    const Followed robot = drive(200'000, driving);
    for (const std::int64_t ahead_us : {2'500, 5'000, 20'000})
        expect_near(pose_of(robot.predict(200'000 + ahead_us)), driving(200'000 + ahead_us), 0.02,
                    1e-3);
    // Between two frames, the robot moves by more than two spacings. Without the tracker, a
    // prediction would therefore fail.
    EXPECT_GT(driving(205'000).x - driving(200'000).x, 2);
}

TEST(TrackerPredict, TurnsTheMotionOfAWorldIntoThePattern) {
    const Followed robot = drive(200'000, driving, true);
    expect_near(pose_of(robot.predict(205'000)), driving(205'000), 0.02, 1e-3);
}

TEST(TrackerPredict, TheReferencePointMovesAsTheFilterSays) {
    DeviceOptions options;
    options.reference_dx_q8 = 60 * 256;
    options.reference_dy_q8 = -20 * 256;
    Followed robot;
    for (std::int64_t t = 0; t <= 200'000; t += kFrame_us) {
        // The camera turns about the reference point, so this point does not move.
        const Pose centre{5000.25, 7000.5, 0.4 + 3e-6 * static_cast<double>(t)};
        robot.fix = fix_at(centre);
        const Pose there = pose_of(Prediction::like(robot.fix), 60, -20);
        robot.sighting = sighting_of(fix_at({5000.25, 7000.5, centre.theta_rad}), t);
        robot.tracker.update(t, &robot.sighting);
        if (t < 200'000) continue;
        const Pose later = pose_of(robot.predict(205'000, options), 60, -20);
        expect_near(later, {there.x, there.y, centre.theta_rad + 0.015}, 1e-3, 1e-3);
    }
}

TEST(TrackerPredict, ARestingRobotIsExpectedWhereItWasAndAlmostSurely) {
    const Followed robot = drive(500'000, [](std::int64_t) { return Pose{10.75, 20.25, -3.1}; });
    const Prediction prediction = robot.predict(505'000);
    expect_near(pose_of(prediction), {10.75, 20.25, -3.1}, 0.001, 1e-4);
    EXPECT_LT(prediction.sigma_q16, Prediction{}.sigma_q16);
    EXPECT_LT(prediction.sigma_theta_bam, Prediction{}.sigma_theta_bam);
    // A push can accelerate the robot at 10 m/s^2 for 5 ms, which displaces it by 0.125 mm.
    EXPECT_GT(3 * prediction.sigma_q16, static_cast<std::int32_t>(0.125 / 0.508 * 65536));
    EXPECT_EQ(prediction.displacement_q16, robot.fix.displacement_q16);
}

TEST(TrackerPredict, IsLessSureLater) {
    const Followed robot = drive(500'000, driving);
    const Prediction soon = robot.predict(501'000);
    const Prediction later = robot.predict(505'000);
    EXPECT_LT(soon.sigma_q16, later.sigma_q16);
    EXPECT_LE(soon.sigma_theta_bam, later.sigma_theta_bam);
    EXPECT_GT(soon.sigma_q16, 65536 / 64);
    EXPECT_EQ(robot.predict(560'000).sigma_q16, Prediction{}.sigma_q16);
}

TEST(TrackerPredict, ExpectsNothingWhereTheFilterDoesNot) {
    Followed robot;
    robot.fix = fix_at(driving(0));
    robot.sighting = sighting_of(robot.fix, 0);
    expect_as_seen(robot.predict(kFrame_us), robot.fix);  // the tracker has no sighting yet
    robot = drive(200'000, driving);
    expect_as_seen(robot.predict(200'000), robot.fix);  // not later than the newest frame
    expect_as_seen(robot.predict(100'000), robot.fix);
    // 70 ms after its last sighting, the robot is lost, so the tracker makes no prediction.
    expect_as_seen(robot.predict(270'000), robot.fix);
    robot.tracker.update(300'000, nullptr);
    EXPECT_FALSE(robot.tracker.has_prior());
    expect_as_seen(robot.predict(305'000), robot.fix);
}

/// Returns the pose of a robot that moves as in `driving`, but in another part of the pattern.
Pose driving_elsewhere(std::int64_t time_us) {
    const Pose pose = driving(time_us);
    return {pose.x + 9000, pose.y - 3000, pose.theta_rad};
}

TEST(TrackerPredict, OneSightingThatContradictsTellsNoSpeed) {
    Followed robot = drive(200'000, driving);
    const Pose elsewhere = driving_elsewhere(205'000);
    robot.see(elsewhere, 205'000);
    ASSERT_EQ(robot.tracker.track().verdict, Verdict::gated);
    const Prediction prediction = robot.predict(210'000);
    expect_near(pose_of(prediction), elsewhere, 0.001, 1e-4);
    EXPECT_EQ(prediction.sigma_q16, Prediction{}.sigma_q16);
}

TEST(TrackerPredict, FollowsARobotThatWasPutElsewhereBeforeItBelievesIt) {
    Followed robot = drive(200'000, driving);
    robot.see(driving_elsewhere(205'000), 205'000);
    robot.see(driving_elsewhere(210'000), 210'000);
    ASSERT_EQ(robot.tracker.track().verdict, Verdict::gated);
    expect_near(pose_of(robot.predict(215'000)), driving_elsewhere(215'000), 0.3, 0.02);
}

TEST(TrackerPredict, KeepsTheSpeedOfARobotThatIsBelievedToBeElsewhere) {
    Followed robot = drive(200'000, driving);
    std::int64_t time_us = 200'000;
    while (robot.tracker.track().verdict != Verdict::accepted || time_us == 200'000) {
        time_us += kFrame_us;
        ASSERT_LT(time_us, 300'000);
        robot.see(driving_elsewhere(time_us), time_us);
    }
    EXPECT_TRUE(robot.tracker.track().events.kidnapped);
    EXPECT_NEAR(std::hypot(robot.tracker.track().pose.vx_mm_s, robot.tracker.track().pose.vy_mm_s),
                300, 15);
    expect_near(pose_of(robot.predict(time_us + kFrame_us)), driving_elsewhere(time_us + kFrame_us),
                0.3, 0.02);
}

TEST(TrackerPredict, BridgesFramesWithoutAFix) {
    Followed robot = drive(200'000, driving);
    robot.tracker.update(205'000, nullptr);
    expect_near(pose_of(robot.predict(210'000)), driving(210'000), 0.02, 1e-3);
}

TEST(TrackerPredict, PassesTheEndOfThePattern) {
    // Past the last column, the pattern restarts in other sections.
    const Followed robot = drive(200'000, [](std::int64_t t) {
        return Pose{kPositionsPerAxis - 1.0 - static_cast<double>(200'000 - t) / 5000, 5, 0};
    });
    const Prediction next = robot.predict(210'000);
    EXPECT_LT(next.place.cell.x, 3U);
    EXPECT_NE(next.place.section, robot.fix.section);
}

TEST(TrackerPredict, SurvivesAnyInput) {
    constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
    const Followed driven = drive(200'000, driving);
    for (const std::int64_t time_us : {-kMax - 1, std::int64_t{0}, kMax})
        expect_as_seen(driven.predict(time_us), driven.fix);
    Followed other = driven;
    other.sighting.spacing_nm = 0;
    expect_as_seen(other.predict(205'000), other.fix);
    other.sighting.spacing_nm = 1;  // makes the predicted motion, in spacings, too large
    expect_as_seen(other.predict(205'000), other.fix);
    other.sighting = driven.sighting;
    other.sighting.x_nm += 1'000'000'000'000;
    expect_as_seen(other.predict(205'000), other.fix);
    other.sighting = driven.sighting;
    other.sighting.covariance[0][0] = std::nanf("");
    EXPECT_EQ(other.predict(205'000).sigma_q16, Prediction{}.sigma_q16);
}

}  // namespace
}  // namespace dotpose::predict_test
