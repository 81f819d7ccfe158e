// Tests trackers that combine sightings with odometry, which measures the motion between frames.
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

#include "dotpose/tools/random.hpp"
#include "dotpose/track.hpp"

namespace dotpose::track_motion_test {
namespace {

constexpr std::uint64_t kSeed = 31;
constexpr std::int64_t kFrame_us = 5000;
constexpr double kBam_per_rad = 2147483648.0 / std::numbers::pi;

struct Pose {
    double x_mm = 0;
    double y_mm = 0;
    double theta_rad = 0;
};

/// Returns a pose on a circle with a radius of 50 mm. The robot drives at 100 mm/s, and the x axis
/// of its camera points ahead. If the y axis of the plane points up, y and the angle change sign.
Pose pose_at(double time_s, bool is_y_up) {
    const double theta = 2 * time_s;
    const double sign = is_y_up ? -1 : 1;
    return {50 * std::sin(theta), sign * 50 * (1 - std::cos(theta)), sign * theta};
}

Sighting sighting_at(std::int64_t time_us, bool is_y_up, Rng& rng) {
    constexpr double kSigma_mm = 0.002;
    constexpr double kSigma_rad = 0.0003;
    const Pose pose = pose_at(static_cast<double>(time_us) * 1e-6, is_y_up);
    Sighting sighting;
    sighting.time_us = time_us;
    sighting.x_nm = std::llround((pose.x_mm + kSigma_mm * rng.normal()) * 1e6);
    sighting.y_nm = std::llround((pose.y_mm + kSigma_mm * rng.normal()) * 1e6);
    const double theta_rad = pose.theta_rad + kSigma_rad * rng.normal();
    sighting.theta_bam = static_cast<std::int32_t>(
        static_cast<std::uint32_t>(std::llround(theta_rad * kBam_per_rad)));
    sighting.covariance[0][0] = sighting.covariance[1][1] =
        static_cast<float>(kSigma_mm * kSigma_mm);
    sighting.covariance[2][2] = static_cast<float>(kSigma_rad * kSigma_rad);
    sighting.p_wrong_log2 = -60;
    sighting.is_y_up = is_y_up;
    return sighting;
}

/// Returns the measured motion during one frame period, with normally distributed errors. The
/// displacement is along the axes of the robot before the motion.
MeasuredMotion odometry_until(std::int64_t time_us, bool is_y_up, Rng& rng) {
    constexpr double kSigma_mm = 0.01;
    constexpr double kSigma_rad = 0.0005;
    const Pose from = pose_at(static_cast<double>(time_us - kFrame_us) * 1e-6, is_y_up);
    const Pose to = pose_at(static_cast<double>(time_us) * 1e-6, is_y_up);
    const double x = to.x_mm - from.x_mm;
    const double y = to.y_mm - from.y_mm;
    const double c = std::cos(from.theta_rad);
    const double s = std::sin(from.theta_rad);
    const double sign = is_y_up ? -1 : 1;
    MeasuredMotion motion;
    motion.right_mm = static_cast<float>(c * x + s * y + kSigma_mm * rng.normal());
    motion.down_mm = static_cast<float>(sign * (c * y - s * x) + kSigma_mm * rng.normal());
    motion.turn_rad =
        static_cast<float>(sign * (to.theta_rad - from.theta_rad) + kSigma_rad * rng.normal());
    motion.sigma_mm = static_cast<float>(kSigma_mm);
    motion.sigma_rad = static_cast<float>(kSigma_rad);
    return motion;
}

/// Returns b^T a^-1 b for a symmetric positive definite matrix a, by Gaussian elimination.
double mahalanobis(std::array<std::array<double, 3>, 3> a, std::array<double, 3> b) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        sum += b[k] * b[k] / a[k][k];
        for (std::size_t i = k + 1; i < 3; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < 3; ++j)
                a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    return sum;
}

/// Returns the squared error of the pose, normalised by its covariance. The expected value is 3.
double relative_error(const TrackedPose& pose, bool is_y_up) {
    const Pose truth = pose_at(static_cast<double>(pose.time_us) * 1e-6, is_y_up);
    std::array<std::array<double, 3>, 3> covariance{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            covariance[i][j] = static_cast<double>(pose.covariance[i][j]);
    }
    return mahalanobis(covariance,
                       {pose.x_mm() - truth.x_mm, pose.y_mm() - truth.y_mm,
                        std::remainder(pose.theta_rad() - truth.theta_rad, 2 * std::numbers::pi)});
}

class TrackMotion : public testing::TestWithParam<bool> {};

// For one second, the robot drives over the pattern. In the next three seconds, it drives over a
// table without a pattern.
TEST_P(TrackMotion, OdometryCarriesThePoseAcrossAGap) {
    const bool is_y_up = GetParam();
    constexpr int kDrives = 200;
    std::array<double, 3> relative{};  // after 0.1, 1 and 3 s
    double sigma_mm = 0;
    for (int drive = 0; drive < kDrives; ++drive) {
        Rng rng(kSeed, static_cast<std::uint64_t>(drive));
        Tracker tracker;
        for (std::int64_t t = 0; t <= 4'000'000; t += kFrame_us) {
            const MeasuredMotion motion = odometry_until(t, is_y_up, rng);
            const Sighting sighting = sighting_at(t, is_y_up, rng);
            tracker.update(t, t <= 1'000'000 ? &sighting : nullptr, motion);
            const auto add = [&](std::size_t i) {
                relative[i] += relative_error(tracker.track().pose, is_y_up);
            };
            if (t == 1'100'000) add(0);
            if (t == 2'000'000) add(1);
            if (t == 4'000'000) add(2);
        }
        EXPECT_FALSE(tracker.track().is_lost);
        sigma_mm = std::sqrt(static_cast<double>(tracker.track().pose.covariance[0][0]));
        EXPECT_NEAR(tracker.track().pose.turn_rad_s, is_y_up ? -2 : 2, 0.3);
    }
    for (const double sum : relative) {
        EXPECT_GT(sum / (3 * kDrives), 0.8);
        EXPECT_LT(sum / (3 * kDrives), 1.25);
    }
    // The sum of 600 steps with independent errors of 0.01 mm has a standard deviation of 0.24 mm.
    // The rotation errors, 0.012 rad in total, add to the error of the position.
    EXPECT_GT(sigma_mm, 0.24);
    EXPECT_LT(sigma_mm, 1.5);
}
INSTANTIATE_TEST_SUITE_P(YAxis, TrackMotion, testing::Bool(),
                         [](const auto& up) { return up.param ? "up" : "down"; });

TEST(TrackMotionLost, ARobotIsLostWhenItsOdometryIsTooUncertain) {
    Rng rng(kSeed);
    TrackOptions options;
    options.max_sigma_mm = 0.1F;
    Tracker tracker(options);
    const Sighting sighting = sighting_at(0, false, rng);
    tracker.update(0, &sighting);
    std::int64_t lost_us = 0;
    for (std::int64_t t = kFrame_us; t <= 2'000'000 && lost_us == 0; t += kFrame_us) {
        tracker.update(t, nullptr, odometry_until(t, false, rng));
        if (tracker.track().events.lost) lost_us = t;
    }
    // The sum of 100 steps with independent errors of 0.01 mm has a standard deviation of 0.1 mm,
    // which is the limit. The limit is reached earlier because the rotation also has errors.
    EXPECT_GT(lost_us, 20 * kFrame_us);
    EXPECT_LT(lost_us, 102 * kFrame_us);
}

TEST(TrackMotionLost, WithoutFurtherMotionsARobotIsLostAsBefore) {
    Rng rng(kSeed);
    Tracker tracker;
    const Sighting sighting = sighting_at(0, false, rng);
    tracker.update(0, &sighting);
    tracker.update(200'000, nullptr, {.sigma_mm = 0.01F, .sigma_rad = 0.001F});
    EXPECT_FALSE(tracker.track().is_lost);
    tracker.update(265'000, nullptr);
    EXPECT_FALSE(tracker.track().is_lost);
    tracker.update(275'000, nullptr);
    EXPECT_TRUE(tracker.track().is_lost);
}

}  // namespace
}  // namespace dotpose::track_motion_test
