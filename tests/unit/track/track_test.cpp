#include "dotpose/track.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "dotpose/tools/random.hpp"

namespace dotpose::track_test {
namespace {

constexpr std::int64_t kFrame_us = 5000;
constexpr double kPi = std::numbers::pi;
/// Coordinate of a position near the corner of the pattern plane that is farthest from the origin.
constexpr std::int64_t kFar_nm = 208'694'000'000'000;

std::int32_t bam(double angle_rad) {
    return static_cast<std::int32_t>(
        static_cast<std::int64_t>(std::llround(angle_rad / kPi * 2147483648.0)) & 0xFFFFFFFF);
}

Sighting at(std::int64_t time_us, double x_mm, double y_mm = 0, double theta_rad = 0) {
    constexpr float kSigma_mm = 0.002F;
    constexpr float kSigma_rad = 0.0003F;
    Sighting sighting;
    sighting.time_us = time_us;
    sighting.x_nm = kFar_nm + std::llround(x_mm * 1e6);
    sighting.y_nm = std::llround(y_mm * 1e6);
    sighting.theta_bam = bam(theta_rad);
    sighting.covariance[0][0] = sighting.covariance[1][1] = kSigma_mm * kSigma_mm;
    sighting.covariance[2][2] = kSigma_rad * kSigma_rad;
    sighting.p_wrong_log2 = -60;
    return sighting;
}

const Track& see(Tracker& tracker, const Sighting& sighting) {
    return tracker.update(sighting.time_us, &sighting);
}

std::string events_of(const Track& track) {
    const TrackEvents& e = track.events;
    return std::string(e.fix ? "fix " : "") + (e.lost ? "lost " : "") +
           (e.kidnapped ? "kidnapped " : "") + (e.stationary ? "stationary " : "") +
           (e.moving ? "moving " : "");
}

/// Drives at 100 mm/s along x and turns at 2 rad/s. The last frame is before `end_us`.
void drive(Tracker& tracker, std::int64_t begin_us, std::int64_t end_us) {
    for (std::int64_t t = begin_us; t < end_us; t += kFrame_us) {
        const double s = static_cast<double>(t) * 1e-6;
        see(tracker, at(t, 100 * s, 0, 2 * s));
    }
}

TEST(Tracker, StartsLostAndBelievesTheFirstFix) {
    Tracker tracker;
    EXPECT_TRUE(tracker.track().is_lost);
    EXPECT_FALSE(tracker.has_prior());
    EXPECT_EQ(events_of(tracker.update(0, nullptr)), "");
    const Track& track = see(tracker, at(kFrame_us, 7, 8, 0.5));
    EXPECT_EQ(events_of(track), "fix ");
    EXPECT_EQ(track.verdict, Verdict::accepted);
    EXPECT_EQ(track.p_wrong_log2, -60);
    EXPECT_FALSE(track.is_lost);
    EXPECT_EQ(track.pose.x_nm, kFar_nm + 7'000'000);
    EXPECT_EQ(track.pose.y_nm, 8'000'000);
    EXPECT_EQ(track.pose.theta_bam, bam(0.5));
    EXPECT_TRUE(tracker.has_prior());
}

TEST(Tracker, FollowsConstantVelocityAndTurnsPastHalfATurn) {
    Tracker tracker;
    drive(tracker, 0, 4'000'000);  // turns by 8 rad, which is more than a full turn
    const TrackedPose& pose = tracker.track().pose;
    const double s = 3.995;
    EXPECT_NEAR(pose.vx_mm_s, 100, 0.01);
    EXPECT_NEAR(pose.vy_mm_s, 0, 0.01);
    EXPECT_NEAR(pose.turn_rad_s, 2, 0.001);
    EXPECT_NEAR(static_cast<double>(pose.x_nm - kFar_nm), 100e6 * s, 20);
    EXPECT_NEAR(std::remainder(pose.theta_rad() - 2 * s, 2 * kPi), 0, 1e-6);
}

TEST(Tracker, PredictsBetweenSightings) {
    Tracker tracker;
    drive(tracker, 0, 1'000'000);
    const auto before = tracker.track().pose.covariance;
    const Track& track = tracker.update(1'050'000, nullptr);
    EXPECT_EQ(track.verdict, Verdict::none);
    EXPECT_NEAR(static_cast<double>(track.pose.x_nm - kFar_nm), 105e6, 2000);
    EXPECT_NEAR(std::remainder(track.pose.theta_rad() - 2.1, 2 * kPi), 0, 1e-4);
    EXPECT_GT(track.pose.covariance[0][0], before[0][0]);
    EXPECT_GT(track.pose.covariance[3][3], before[3][3]);
}

TEST(Tracker, IsLostAfterTheDebounce) {
    Tracker tracker;
    drive(tracker, 0, 100'000);  // the last sighting is at 95 ms
    for (std::int64_t t = 100'000; t < 165'000; t += kFrame_us)
        EXPECT_EQ(events_of(tracker.update(t, nullptr)), "") << t;
    EXPECT_EQ(events_of(tracker.update(165'000, nullptr)), "lost ");
    EXPECT_TRUE(tracker.track().is_lost);
    EXPECT_FALSE(tracker.has_prior());
    EXPECT_EQ(events_of(tracker.update(170'000, nullptr)), "");
    // The robot is found again at a position that it could have reached in the meantime.
    EXPECT_EQ(events_of(see(tracker, at(175'000, 40, 30))), "fix ");
}

TEST(Tracker, SurvivesShortGaps) {
    Tracker tracker;
    drive(tracker, 0, 100'000);
    tracker.update(130'000, nullptr);
    const Track& track = see(tracker, at(160'000, 16, 0, 0.32));
    EXPECT_EQ(events_of(track), "");
    EXPECT_EQ(track.verdict, Verdict::accepted);
}

TEST(Tracker, DoesNotBelieveASingleWrongFix) {
    Tracker tracker;
    drive(tracker, 0, 100'000);
    for (const Sighting& wrong :
         {at(100'000, 5000, 5000), at(100'000, 10, 3), at(100'000, 10, 0, 1)}) {
        Tracker copy = tracker;
        const Track& track = see(copy, wrong);
        EXPECT_EQ(track.verdict, Verdict::gated);
        EXPECT_EQ(track.p_wrong_log2, 0);
        EXPECT_EQ(events_of(track), "");
        EXPECT_NEAR(static_cast<double>(track.pose.x_nm - kFar_nm), 10e6, 5000);
        EXPECT_EQ(see(copy, at(105'000, 10.5, 0, 0.21)).verdict, Verdict::accepted);
    }
}

TEST(Tracker, BelievesAJumpOnceConfirmed) {
    Tracker tracker;
    drive(tracker, 0, 100'000);
    EXPECT_EQ(see(tracker, at(100'000, 80, 90, 1)).verdict, Verdict::gated);
    EXPECT_EQ(see(tracker, at(105'000, 80.1, 90, 1)).verdict, Verdict::gated);
    const Track& track = see(tracker, at(110'000, 80.2, 90, 1));
    EXPECT_EQ(events_of(track), "kidnapped ");
    EXPECT_EQ(track.verdict, Verdict::accepted);
    EXPECT_EQ(track.pose.x_nm, kFar_nm + 80'200'000);
}

TEST(Tracker, JumpsThatDisagreeConfirmNothing) {
    Tracker tracker({.lost_after_us = 10'000'000});
    drive(tracker, 0, 100'000);
    Rng rng(8);
    for (std::int64_t t = 100'000; t < 400'000; t += kFrame_us) {
        const Track& track = see(tracker, at(t, rng.uniform(1000, 1e6), rng.uniform(1000, 1e6)));
        EXPECT_EQ(track.verdict, Verdict::gated);
        EXPECT_EQ(events_of(track), "");
    }
}

TEST(Tracker, IsKidnappedIfFoundBeyondReach) {
    Tracker tracker({.max_speed_mm_s = 300});
    drive(tracker, 0, 100'000);
    tracker.update(200'000, nullptr);  // lost
    // The robot cannot have driven to these sightings, which are 120 mm from its last position. At
    // 300 mm/s, it moves by at most 90 mm in the 0.3 s from its last sighting to the first of these
    // sightings.
    EXPECT_EQ(events_of(see(tracker, at(395'000, 130))), "");
    EXPECT_TRUE(tracker.track().is_lost);
    EXPECT_EQ(events_of(see(tracker, at(400'000, 130))), "");
    EXPECT_EQ(events_of(see(tracker, at(405'000, 130))), "fix kidnapped ");
}

TEST(Tracker, AnotherPlaneIsAJump) {
    Tracker tracker;
    drive(tracker, 0, 100'000);
    for (const std::int64_t t : {100'000, 105'000, 110'000}) {
        Sighting sighting = at(t, 10);
        sighting.plane = 5;
        const Track& track = see(tracker, sighting);
        EXPECT_EQ(events_of(track), t == 110'000 ? "kidnapped " : "") << t;
    }
}

Sighting weak(Sighting sighting, int p_wrong_log2) {
    sighting.p_wrong_log2 = p_wrong_log2;
    return sighting;
}

TEST(Tracker, BelievesWeakSightingsThatThePriorSupports) {
    Tracker tracker;
    drive(tracker, 0, 100'000);
    const Track& track = see(tracker, weak(at(100'000, 10, 0, 0.2), -12));
    EXPECT_EQ(track.verdict, Verdict::with_prior);
    // The gate extends at least 0.125 mm to each side (half the permitted acceleration times the
    // square of the time), but is narrower than a cell. It therefore contains 2 to 4 of the 2^36
    // hypotheses.
    EXPECT_GE(track.p_wrong_log2, -12 + 1 - 36);
    EXPECT_LE(track.p_wrong_log2, -12 + 2 - 36);
}

TEST(Tracker, RefusesOtherWeakSightings) {
    const auto verdict = [](std::int64_t time_us, const Sighting& sighting) {
        Tracker tracker;
        drive(tracker, 0, 100'000);
        tracker.update(time_us - 1, nullptr);
        return see(tracker, sighting).verdict;
    };
    // Three sightings must be refused: one outside the gate, one whose p_wrong is hardly better
    // than chance, and one that arrives while the robot is lost.
    EXPECT_EQ(verdict(100'000, weak(at(100'000, 12, 0, 0.2), -12)), Verdict::too_weak);
    EXPECT_EQ(verdict(100'000, weak(at(100'000, 10, 0, 0.2), -9)), Verdict::too_weak);
    EXPECT_EQ(verdict(165'000, weak(at(165'000, 16.5, 0, 0.33), -12)), Verdict::too_weak);
    // After 60 ms without a sighting, the gate extends by about 18 mm to each side of the
    // prediction, so it may contain alternatives.
    EXPECT_EQ(verdict(155'000, weak(at(155'000, 15.5, 0, 0.31), -12)), Verdict::too_weak);
    EXPECT_EQ(verdict(120'000, weak(at(120'000, 12, 0, 0.24), -12)), Verdict::with_prior);
}

TEST(Tracker, WeakSightingsNeverConfirmAJump) {
    Tracker tracker;
    drive(tracker, 0, 100'000);
    for (std::int64_t t = 100'000; t < 150'000; t += kFrame_us)
        EXPECT_EQ(see(tracker, weak(at(t, 80), -29)).verdict, Verdict::too_weak);
}

TEST(Tracker, TellsRestFromMovement) {
    Tracker tracker;
    std::vector<std::pair<std::int64_t, std::string>> events;
    Rng rng(5);
    for (std::int64_t t = 0; t < 3'000'000; t += kFrame_us) {
        // Drives for 1 s, rests for 1 s, and continues.
        const double s = static_cast<double>(t) * 1e-6;
        const double driven_s = s < 1 ? s : s < 2 ? 1 : s - 1;
        const Track& track =
            see(tracker, at(t, 50 * driven_s + 0.002 * rng.normal(), 0.002 * rng.normal()));
        if (!events_of(track).empty()) events.emplace_back(t, events_of(track));
    }
    ASSERT_EQ(events.size(), 3U);
    EXPECT_EQ(events[0].second, "fix ");
    EXPECT_EQ(events[1].second, "stationary ");
    // The robot is considered to be at rest once it is within 0.1 mm of its final position. After
    // the sudden stop, the filter needs a few frames to settle.
    EXPECT_NEAR(static_cast<double>(events[1].first), 1.5e6, 30e3);
    EXPECT_EQ(events[2].second, "moving ");
    EXPECT_NEAR(static_cast<double>(events[2].first), 2.0e6, 10e3);  // moving by 0.1 mm takes 2 ms
}

TEST(Tracker, ATurnIsMovementToo) {
    Tracker tracker;
    for (std::int64_t t = 0; t < 2'000'000; t += kFrame_us) {
        const Track& track = see(tracker, at(t, 0, 0, static_cast<double>(t) * 1e-6 * 0.2));
        EXPECT_FALSE(track.is_stationary);
    }
}

TEST(Tracker, IgnoresFramesThatAreNotNewer) {
    Tracker tracker;
    drive(tracker, 0, 100'000);
    const TrackedPose before = tracker.track().pose;
    see(tracker, at(95'000, 500));
    see(tracker, at(0, 500));
    EXPECT_EQ(tracker.track().pose.x_nm, before.x_nm);
    EXPECT_EQ(tracker.track().pose.time_us, before.time_us);
}

TEST(Tracker, TakesAFixInTheUnitsOfThePattern) {
    Fix fix;
    fix.status = Status::ok;
    fix.cell = {410'815'347, 2};
    fix.fraction_x_q16 = 0x8000;
    fix.theta_bam = 5;
    fix.section = {1, 2};
    fix.p_wrong_log2 = -40;
    fix.covariance[0][0] = 4;
    fix.covariance[0][2] = 4;
    fix.covariance[2][2] = 4;
    fix.spacing_nm = 500'000;
    const Sighting sighting = sighting_of(fix, 77);
    EXPECT_EQ(sighting.time_us, 77);
    EXPECT_EQ(sighting.x_nm, 205'407'673'750'000);
    EXPECT_EQ(sighting.y_nm, 1'000'000);
    EXPECT_EQ(sighting.theta_bam, 5);
    EXPECT_EQ(sighting.plane, 65U);
    EXPECT_EQ(sighting.p_wrong_log2, -40);
    EXPECT_FLOAT_EQ(sighting.covariance[0][0], 1);
    EXPECT_FLOAT_EQ(sighting.covariance[0][2], 2);
    EXPECT_FLOAT_EQ(sighting.covariance[2][2], 4);
}

}  // namespace
}  // namespace dotpose::track_test
