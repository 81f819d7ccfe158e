// Tests the errors of the filter, and whether the reported covariance agrees with these errors.
#include "track/filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

#include "../../drive.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::track {
namespace {

using test::Drive;
using test::DriveState;

constexpr std::int64_t kFrame_us = 5000;
constexpr double kFrame_s = 0.005;
constexpr double kPi = std::numbers::pi;

using Pose = std::array<double, 3>;  ///< x and y in mm, and the angle in rad

std::int32_t bam(double angle_rad) {
    return static_cast<std::int32_t>(
        static_cast<std::int64_t>(std::llround(angle_rad / kPi * 2147483648.0)) & 0xFFFFFFFF);
}

Sighting at(int frame, const Pose& pose, const Matrix3& covariance) {
    Sighting sighting;
    sighting.time_us = frame * kFrame_us;
    sighting.x_nm = std::llround(pose[0] * 1e6);
    sighting.y_nm = std::llround(pose[1] * 1e6);
    sighting.theta_bam = bam(pose[2]);
    sighting.covariance = covariance;
    sighting.p_wrong_log2 = -60;
    return sighting;
}

/// Returns a covariance typical of a view 8 mm wide: `sigma_mm` along x and y, and `sigma_mm` / 4
/// rad for the angle.
Matrix3 round_covariance(double sigma_mm) {
    const auto variance = static_cast<float>(sigma_mm * sigma_mm);
    return {{{variance, 0, 0}, {0, variance, 0}, {0, 0, variance / 16}}};
}

Pose disturbed(const Pose& pose, double sigma_mm, Rng& rng) {
    return {pose[0] + sigma_mm * rng.normal(), pose[1] + sigma_mm * rng.normal(),
            pose[2] + sigma_mm / 4 * rng.normal()};
}

Pose error_of(const TrackedPose& found, const Pose& pose) {
    return {static_cast<double>(found.x_nm) * 1e-6 - pose[0],
            static_cast<double>(found.y_nm) * 1e-6 - pose[1],
            std::remainder(found.theta_rad() - pose[2], 2 * kPi)};
}

/// Solves m x = b by Gaussian elimination with pivoting, as an independent solution in double
/// precision.
std::array<double, 6> solved(const Covariance9& covariance, std::array<double, 6> b) {
    std::array<std::array<double, 6>, 6> m{};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            m[i][j] = static_cast<double>(covariance[i][j]);
    }
    for (std::size_t i = 0; i < 6; ++i) {
        std::size_t pivot = i;
        for (std::size_t k = i; k < 6; ++k) {
            if (std::abs(m[k][i]) > std::abs(m[pivot][i])) pivot = k;
        }
        std::swap(m[i], m[pivot]);
        std::swap(b[i], b[pivot]);
        for (std::size_t k = i + 1; k < 6; ++k) {
            const double factor = m[k][i] / m[i][i];
            for (std::size_t j = i; j < 6; ++j)
                m[k][j] -= factor * m[i][j];
            b[k] -= factor * b[i];
        }
    }
    for (std::size_t i = 6; i-- > 0;) {
        for (std::size_t j = i + 1; j < 6; ++j)
            b[i] -= m[i][j] * b[j];
        b[i] /= m[i][i];
    }
    return b;
}

/// A robot whose motion matches the model of the filter for an agility of 1. The accelerations are
/// constant between two frames. Their standard deviations are those in TrackOptions. At each frame,
/// each acceleration is multiplied by 0.5 / 0.505, and random noise is added.
struct ModelRobot {
    explicit ModelRobot(Rng& rng) {
        pose[2] = rng.uniform(-kPi, kPi);
        speed = {rng.uniform(-300, 300), rng.uniform(-300, 300), rng.uniform(-5, 5)};
        for (std::size_t i = 0; i < 3; ++i)
            acceleration[i] = spread(i) * rng.normal();
    }
    void drive_on(Rng& rng) {
        constexpr double kKept = 0.5 / 0.505;
        for (std::size_t i = 0; i < 3; ++i) {
            acceleration[i] =
                kKept * acceleration[i] + std::sqrt(1 - kKept * kKept) * spread(i) * rng.normal();
            pose[i] += speed[i] * kFrame_s + acceleration[i] * kFrame_s * kFrame_s / 2;
            speed[i] += acceleration[i] * kFrame_s;
        }
    }
    static double spread(std::size_t axis) { return axis < 2 ? 600 : 6; }

    Pose pose{};
    Pose speed{};
    Pose acceleration{};
};

TEST(Filter, ItsCovarianceIsThatOfItsErrors) {
    // The errors of x, y and angle in one measurement are correlated. The estimate consists of
    // three pose components and their speeds. Its squared error, normalised by its covariance, has
    // a chi-squared distribution with six degrees of freedom, whose mean is 6 and whose variance is
    // 12.
    TrackOptions options;
    options.min_sigma_mm = options.min_sigma_rad = 0;
    constexpr std::array<float, 3> kOwn = {0.004F, 0.004F, 0.0004F};
    constexpr std::array<float, 3> kCommon = {0.003F, -0.003F, 0.0003F};
    Matrix3 covariance{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            covariance[i][j] = kCommon[i] * kCommon[j] + (i == j ? kOwn[i] * kOwn[i] : 0.0F);
    }
    constexpr int kRuns = 400;
    double sum = 0;
    for (std::uint64_t run = 0; run < kRuns; ++run) {
        Rng rng(31, run);
        ModelRobot robot(rng);
        MotionEstimate motion;
        for (int frame = 0; frame < 60; ++frame) {
            if (frame > 0) robot.drive_on(rng);
            const double common = rng.normal();
            Pose seen = robot.pose;
            for (std::size_t i = 0; i < 3; ++i) {
                seen[i] += static_cast<double>(kOwn[i]) * rng.normal() +
                           static_cast<double>(kCommon[i]) * common;
            }
            const Sighting sighting = at(frame, seen, covariance);
            motion = frame == 0 ? started_at(sighting, options)
                                : corrected(predicted(motion, sighting.time_us, options), sighting,
                                            options);
        }
        const Pose off = error_of(motion.pose, robot.pose);
        const std::array<double, 6> error = {
            off[0],
            off[1],
            off[2],
            static_cast<double>(motion.pose.vx_mm_s) - robot.speed[0],
            static_cast<double>(motion.pose.vy_mm_s) - robot.speed[1],
            static_cast<double>(motion.pose.turn_rad_s) - robot.speed[2]};
        const auto weighted = solved(motion.covariance, error);
        for (std::size_t i = 0; i < 6; ++i)
            sum += error[i] * weighted[i];
    }
    // The tolerance is four standard deviations of the mean.
    EXPECT_NEAR(sum / kRuns, 6, 4 * std::sqrt(12.0 / kRuns));
}

/// Rms errors of the position, per axis.
struct Errors {
    double raw_mm = 0;
    double filtered_mm = 0;
    double normalised = 0;  ///< mean of the squared errors, each divided by its variance

    double gain() const { return filtered_mm / raw_mm; }
};

/// Tracks a robot that drives a figure eight at up to `speed_mm_s` and is not lifted. The error of
/// each sighting is the sum of an independent error and a constant error. The returned errors
/// exclude the first second.
Errors track_eight(double speed_mm_s, double sigma_mm, double constant_mm = 0) {
    Drive drive(
        {.put_down = 1e9, .second_put_down = 1e9, .stop = 9, .end = 10, .speed_mm_s = speed_mm_s});
    TrackOptions options;
    options.min_sigma_mm = 0;
    Tracker tracker(options);
    Rng rng(77);
    Errors errors;
    int counted = 0;
    const double claimed_mm = std::hypot(sigma_mm, constant_mm);
    for (int frame = 0; frame < drive.frames(); ++frame) {
        const DriveState state = drive.at(frame);
        const Pose truth = {state.x_mm, state.y_mm, state.yaw_rad};
        Pose seen = disturbed(truth, sigma_mm, rng);
        seen[0] += constant_mm;
        const Sighting sighting = at(frame, seen, round_covariance(claimed_mm));
        const Track& track = tracker.update(sighting.time_us, &sighting);
        EXPECT_EQ(track.verdict, Verdict::accepted) << frame;
        if (frame < 200) continue;
        const Pose error = error_of(track.pose, truth);
        for (std::size_t i = 0; i < 2; ++i) {
            ++counted;
            errors.raw_mm += std::pow(seen[i] - truth[i], 2);
            errors.filtered_mm += error[i] * error[i];
            errors.normalised +=
                error[i] * error[i] / static_cast<double>(track.pose.covariance[i][i]);
        }
    }
    errors.raw_mm = std::sqrt(errors.raw_mm / counted);
    errors.filtered_mm = std::sqrt(errors.filtered_mm / counted);
    errors.normalised /= counted;
    return errors;
}

TEST(Filter, SmoothsWhatASlowRobotShows) {
    EXPECT_LT(track_eight(0, 0.002).gain(), 0.5);
    EXPECT_LT(track_eight(10, 0.002).gain(), 0.75);
    EXPECT_LT(track_eight(100, 0.002).gain(), 0.9);
}

TEST(Filter, IsNeverWorseThanWhatItSees) {
    for (const double speed : {0, 10, 30, 100, 300, 600}) {
        for (const double sigma : {0.0001, 0.0005, 0.002, 0.01}) {
            const Errors errors = track_eight(speed, sigma);
            EXPECT_LT(errors.gain(), 1) << speed << ' ' << sigma;
            EXPECT_LT(errors.normalised, 1.5) << speed << ' ' << sigma;
        }
    }
}

TEST(Filter, DoesNotTrustErrorsThatAllSightingsShare) {
    // The constant error, like a printing error, is not reduced by averaging, so the covariance
    // must include it.
    const Errors errors = track_eight(0, 0.00005, 0.0005);
    EXPECT_LT(errors.normalised, 1.2);
    EXPECT_GT(errors.normalised, 0.3);
}

/// Returns a tracker for a robot that has been at rest at x = 0 for a second. The sightings have
/// errors of 1 µm.
Tracker standing(Rng& rng) {
    Tracker tracker;
    for (int frame = 0; frame < 200; ++frame) {
        const Sighting sighting = at(frame, disturbed({}, 0.001, rng), round_covariance(0.001));
        tracker.update(sighting.time_us, &sighting);
    }
    return tracker;
}

TEST(Filter, FollowsAHit) {
    Rng rng(3);
    Tracker tracker = standing(rng);
    constexpr double kSpeed_mm_s = 20;
    for (int frame = 200; frame < 220; ++frame) {
        const double x_mm = kSpeed_mm_s * kFrame_s * (frame - 199);
        const Sighting sighting =
            at(frame, disturbed({x_mm, 0, 0}, 0.001, rng), round_covariance(0.001));
        const TrackedPose& pose = tracker.update(sighting.time_us, &sighting).pose;
        EXPECT_NEAR(pose.x_mm(), x_mm, 0.01) << frame;
        if (frame > 200) {
            EXPECT_NEAR(pose.vx_mm_s, kSpeed_mm_s, 1.5) << frame;
        }
    }
}

TEST(Filter, IsNotThrownByASightingThatIsOff) {
    Rng rng(3);
    Tracker tracker = standing(rng);
    for (int frame = 200; frame < 220; ++frame) {
        const double x_mm = frame == 200 ? 0.1 : 0;
        const Sighting sighting =
            at(frame, disturbed({x_mm, 0, 0}, 0.001, rng), round_covariance(0.001));
        // A motion of 0.1 mm in one frame would correspond to a speed of 20 mm/s.
        EXPECT_NEAR(tracker.update(sighting.time_us, &sighting).pose.vx_mm_s, 0, 3) << frame;
    }
}

}  // namespace
}  // namespace dotpose::track
