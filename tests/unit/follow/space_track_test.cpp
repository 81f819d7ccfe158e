// Tests the tracker for the pose of a camera in space. The sightings are simulated from a known
// motion.
#include "dotpose/tools/space_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kHeight_mm = 250;

CameraInSpace camera_of(const Vector3d& position, Quaterniond rotation) {
    if (rotation.w() < 0) rotation.coeffs() = -rotation.coeffs();
    return {position.x(),
            position.y(),
            position.z(),
            {rotation.w(), rotation.x(), rotation.y(), rotation.z()}};
}

Quaterniond rotation_of(const CameraInSpace& camera) {
    const Quaternion& q = camera.rotation;
    return {q.w, q.x, q.y, q.z};
}

/// Returns the true pose of a camera in a moving hand, with tilts of up to 30 degrees.
CameraInSpace hand_at(double t_s) {
    const Quaterniond turn(AngleAxisd(0.3 * t_s, Vector3d::UnitZ()));
    const Quaterniond roll(AngleAxisd(0.35 * std::sin(1.1 * t_s), Vector3d::UnitX()));
    const Quaterniond pitch(AngleAxisd(0.2 + 0.3 * std::cos(1.7 * t_s), Vector3d::UnitY()));
    return camera_of({100 * std::sin(1.9 * t_s), 60 * std::cos(1.57 * t_s),
                      -kHeight_mm + 30 * std::sin(2.5 * t_s)},
                     turn * roll * pitch);
}

/// Returns the error of a pose: position, and rotation vector in the camera frame.
Vector6 error_of(const CameraInSpace& camera, const CameraInSpace& truth) {
    const AngleAxisd turn(rotation_of(camera).conjugate() * rotation_of(truth));
    Vector6 error;
    error << truth.x_mm - camera.x_mm, truth.y_mm - camera.y_mm, truth.z_mm - camera.z_mm,
        std::remainder(turn.angle(), 2 * std::numbers::pi) * turn.axis();
    return error;
}

Matrix6 matrix_of(const SpaceCovariance& covariance) {
    Matrix6 matrix;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            matrix(Eigen::Index(i), Eigen::Index(j)) = covariance[i][j];
    }
    return matrix;
}

/// Makes sightings with correlated errors. As in views of a plane, a tilt error also causes a
/// position error. `correlation` is the correlation between the errors of consecutive sightings,
/// which have most of their dots in common.
class Eye {
  public:
    explicit Eye(double scale = 1, double correlation = 0, std::uint64_t seed = 5)
        : correlation_(correlation), rng_(seed, 1) {
        constexpr std::array kSigmas = {0.02, 0.02, 0.02, 0.0003, 0.0003, 0.0001};
        for (std::size_t i = 0; i < 6; ++i)
            root_(Eigen::Index(i), Eigen::Index(i)) = scale * kSigmas[i];
        root_(0, 4) = kHeight_mm * root_(4, 4);
        root_(1, 3) = -kHeight_mm * root_(3, 3);
    }

    SpaceSighting look_at(const CameraInSpace& truth, double t_s) {
        Vector6 normal;
        for (Eigen::Index i = 0; i < 6; ++i)
            normal[i] = rng_.normal();
        const double kept = is_first_ ? 0 : correlation_;
        normal_ = kept * normal_ + std::sqrt(1 - kept * kept) * normal;
        is_first_ = false;
        const Vector6 error = root_ * normal_;
        const Vector3d turn = error.tail<3>();
        SpaceSighting sighting;
        sighting.time_us = std::llround(1e6 * t_s);
        sighting.camera =
            camera_of(Vector3d(truth.x_mm, truth.y_mm, truth.z_mm) + error.head<3>(),
                      rotation_of(truth) * Quaterniond(AngleAxisd(turn.norm(), turn.normalized())));
        const Matrix6 covariance = root_ * root_.transpose();
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t j = 0; j < 6; ++j)
                sighting.covariance[i][j] = covariance(Eigen::Index(i), Eigen::Index(j));
        }
        return sighting;
    }

  private:
    Matrix6 root_ = Matrix6::Zero();
    Vector6 normal_ = Vector6::Zero();  ///< normalised error of the latest sighting
    double correlation_;
    bool is_first_ = true;
    Rng rng_;
};

/// Sums over all sightings: the normalised squared errors (in total and per axis), and the squared
/// errors per axis.
struct Tally {
    double all = 0;
    Vector6 axes = Vector6::Zero();
    Vector6 squares = Vector6::Zero();
    int count = 0;

    void add(const Vector6& error, const Matrix6& covariance) {
        all += error.dot(covariance.ldlt().solve(error)) / 6;
        axes += error.cwiseAbs2().cwiseQuotient(covariance.diagonal());
        squares += error.cwiseAbs2();
        ++count;
    }
    void expect_honest() const {
        EXPECT_GT(all / count, 0.8);
        EXPECT_LT(all / count, 1.25);
        for (Eigen::Index i = 0; i < 6; ++i) {
            EXPECT_GT(axes[i] / count, 0.7) << i;
            EXPECT_LT(axes[i] / count, 1.25) << i;
        }
    }
};

class SpaceTrackRates : public testing::TestWithParam<int> {};

TEST_P(SpaceTrackRates, SmoothsWithTrueCovariances) {
    SpaceTracker tracker;
    Eye eye;
    Tally raw;
    Tally tracked;
    Tally predicted;
    for (int i = 0; i < 2000; ++i) {
        const double t_s = static_cast<double>(i) / GetParam();
        const CameraInSpace truth = hand_at(t_s);
        const SpaceSighting sighting = eye.look_at(truth, t_s);
        const auto before = tracker.predict(sighting.time_us);
        const SpaceTrack& track = tracker.update(sighting);
        ASSERT_EQ(track.verdict, SpaceVerdict::accepted) << i;
        EXPECT_EQ(track.is_new, i == 0);
        if (i < 60) continue;
        raw.add(error_of(sighting.camera, truth), matrix_of(sighting.covariance));
        tracked.add(error_of(track.camera, truth), matrix_of(track.covariance));
        predicted.add(error_of(before->camera, truth), matrix_of(before->covariance));
    }
    tracked.expect_honest();
    predicted.expect_honest();
    // Tracking reduces the errors of every coordinate.
    EXPECT_LT((tracked.squares.cwiseQuotient(raw.squares)).maxCoeff(), 0.96);
}
INSTANTIATE_TEST_SUITE_P(FramesPerSecond, SpaceTrackRates, testing::Values(30, 60, 200));

/// Errors that change slowly, such as printing errors while the camera moves, cannot be smoothed.
/// The best estimate of the pose is then close to the newest sighting.
TEST_P(SpaceTrackRates, FollowsSightingsWithCommonErrors) {
    constexpr double kCorrelationTime_s = 0.25;
    SpaceTracker tracker;
    Eye eye(0.2, std::exp(-1 / (kCorrelationTime_s * GetParam())));
    Tally raw;
    Tally tracked;
    Tally predicted;
    for (int i = 0; i < 60 * GetParam(); ++i) {
        const double t_s = static_cast<double>(i) / GetParam();
        const CameraInSpace truth = hand_at(t_s);
        const SpaceSighting sighting = eye.look_at(truth, t_s);
        const auto before = tracker.predict(sighting.time_us);
        const SpaceTrack& track = tracker.update(sighting);
        ASSERT_EQ(track.verdict, SpaceVerdict::accepted) << i;
        if (i < 60) continue;
        raw.add(error_of(sighting.camera, truth), matrix_of(sighting.covariance));
        tracked.add(error_of(track.camera, truth), matrix_of(track.covariance));
        predicted.add(error_of(before->camera, truth), matrix_of(before->covariance));
    }
    // The series covers only 240 correlation times, so the mean normalised squared error of an axis
    // has a standard deviation of 0.09. Each axis is therefore compared with the same axis of the
    // sightings.
    for (const Tally& tally : {tracked, predicted}) {
        EXPECT_GT(tally.all / tally.count, 0.8);
        EXPECT_LT(tally.all / tally.count, 1.25);
    }
    EXPECT_LT(tracked.axes.cwiseQuotient(raw.axes).maxCoeff(), 1.1);
    EXPECT_LT(tracked.squares.cwiseQuotient(raw.squares).maxCoeff(), 1.04);
}

/// While the camera rests, all views contain the same dots, and the tracker cannot reduce the
/// printing errors. The covariance of the track must therefore include these errors.
TEST(SpaceTrack, HasTheTrueCovarianceWhileTheCameraRests) {
    Tally tracked;
    const CameraInSpace truth = hand_at(0.7);
    for (std::uint64_t track = 0; track < 100; ++track) {
        SpaceTracker tracker;
        Eye eye(1, 0.9999, 100 + track);
        for (int i = 0; i < 200; ++i)
            tracker.update(eye.look_at(truth, i / 100.0));
        tracked.add(error_of(tracker.track().camera, truth), matrix_of(tracker.track().covariance));
    }
    EXPECT_GT(tracked.all / tracked.count, 0.8);
    EXPECT_LT(tracked.all / tracked.count, 1.25);
}

/// With accurate sightings at a low rate, the errors of predictions are mostly those of the motion
/// model. The innovations then keep the same sign for many frames.
TEST(SpaceTrack, PredictsASmoothMotionWithTrueCovariances) {
    SpaceTracker tracker;
    Eye eye(0.05);
    Tally tracked;
    Tally predicted;
    for (int i = 0; i < 1000; ++i) {
        const double t_s = i / 30.0;
        const CameraInSpace truth = hand_at(t_s);
        const auto before = tracker.predict(std::llround(1e6 * t_s));
        const SpaceTrack& track = tracker.update(eye.look_at(truth, t_s));
        ASSERT_EQ(track.verdict, SpaceVerdict::accepted) << i;
        if (i < 60) continue;
        tracked.add(error_of(track.camera, truth), matrix_of(track.covariance));
        predicted.add(error_of(before->camera, truth), matrix_of(before->covariance));
    }
    tracked.expect_honest();
    predicted.expect_honest();
}

TEST(SpaceTrack, HasTheVelocityOfTheCamera) {
    SpaceTracker tracker;
    Eye eye;
    const Vector3d turn_rad_s(0.2, -0.1, 0.4);
    const auto at = [&](double t_s) {
        return camera_of({30 * t_s, -20 * t_s, -kHeight_mm + 10 * t_s},
                         Quaterniond(AngleAxisd(turn_rad_s.norm() * t_s, turn_rad_s.normalized())));
    };
    for (int i = 0; i <= 300; ++i)
        tracker.update(eye.look_at(at(i / 100.0), i / 100.0));
    const SpaceTrack& track = tracker.track();
    EXPECT_NEAR(track.velocity_mm_s[0], 30, 4);
    EXPECT_NEAR(track.velocity_mm_s[1], -20, 4);
    EXPECT_NEAR(track.velocity_mm_s[2], 10, 4);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(track.turn_rad_s[i], turn_rad_s[Eigen::Index(i)], 0.03);
    const auto later = tracker.predict(3'100'000);
    ASSERT_TRUE(later);
    EXPECT_LT(error_of(later->camera, at(3.1)).head<3>().norm(), 2);
    EXPECT_FALSE(tracker.predict(2'000'000));
}

/// Returns the second possible pose of a camera that sees a plane with weak perspective. The second
/// pose is tilted in the opposite direction.
CameraInSpace mirrored(const CameraInSpace& camera) {
    const Quaterniond half(0, 0, 0, 1);
    const Quaterniond q = rotation_of(camera);
    // q is the product of a turn about the vertical and a tilt (`lean`). The mirrored pose is
    // tilted in the opposite direction.
    const double turn = 2 * std::atan2(q.z(), q.w());
    const Quaterniond about_z(AngleAxisd(turn, Vector3d::UnitZ()));
    const Quaterniond lean = about_z.conjugate() * q;
    return camera_of({camera.x_mm, camera.y_mm, camera.z_mm},
                     about_z * (half * lean * half.conjugate()));
}

TEST(SpaceTrack, SettlesSecondPoses) {
    SpaceTracker tracker;
    Eye eye;
    int seconds = 0;
    for (int i = 0; i < 600; ++i) {
        const double t_s = i / 60.0;
        const CameraInSpace truth = hand_at(t_s);
        SpaceSighting sighting = eye.look_at(truth, t_s);
        const bool is_swapped = i > 10 && i % 3 == 0;
        if (i > 10) {
            sighting.second = SecondPose{mirrored(sighting.camera), -1};
            if (is_swapped) std::swap(sighting.camera, sighting.second->camera);
        }
        const SpaceTrack& track = tracker.update(sighting);
        ASSERT_FALSE(track.is_lost) << i;
        EXPECT_LT(error_of(track.camera, truth).tail<3>().norm(), 0.01) << i;
        if (track.verdict == SpaceVerdict::second_accepted) {
            EXPECT_TRUE(is_swapped) << i;
            ++seconds;
        }
    }
    EXPECT_GT(seconds, 150);
    EXPECT_STREQ(name(SpaceVerdict::second_accepted), "second_accepted");
}

TEST(SpaceTrack, DoesNotStartWithAnAmbiguousPose) {
    SpaceTracker tracker;
    Eye eye;
    SpaceSighting sighting = eye.look_at(hand_at(0), 0);
    sighting.second = SecondPose{mirrored(sighting.camera), -1};
    EXPECT_TRUE(tracker.update(sighting).is_lost);
    EXPECT_EQ(tracker.track().verdict, SpaceVerdict::rejected);
    sighting.second->odds_log2 = -60;  // excludes the second pose
    sighting.time_us = 10'000;
    EXPECT_FALSE(tracker.update(sighting).is_lost);
}

TEST(SpaceTrack, RejectsOutliersAndFollowsAJump) {
    SpaceTracker tracker;
    Eye eye;
    for (int i = 0; i < 200; ++i) {
        const double t_s = i / 100.0;
        SpaceSighting sighting = eye.look_at(hand_at(t_s), t_s);
        const bool is_outlier = i > 20 && i % 7 == 0;
        if (is_outlier) sighting.camera.x_mm += 50;
        const SpaceTrack& track = tracker.update(sighting);
        EXPECT_EQ(track.verdict, is_outlier ? SpaceVerdict::rejected : SpaceVerdict::accepted) << i;
        EXPECT_LT(std::abs(track.camera.x_mm - hand_at(t_s).x_mm), 0.5) << i;
    }
    // The camera is now 500 mm away. The third sighting at this position starts a new track.
    for (int i = 0; i < 3; ++i) {
        const double t_s = 2 + i / 100.0;
        CameraInSpace truth = hand_at(t_s);
        truth.x_mm += 500;
        const SpaceTrack& track = tracker.update(eye.look_at(truth, t_s));
        EXPECT_EQ(track.is_new, i == 2);
        EXPECT_EQ(track.verdict, i == 2 ? SpaceVerdict::accepted : SpaceVerdict::rejected);
    }
    EXPECT_NEAR(tracker.track().camera.x_mm, hand_at(2.02).x_mm + 500, 0.5);
}

/// The track of a camera over a page that is rotated in the world must agree with `in_world`.
TEST(SpaceTrack, IsInTheWorldOfTheSheet) {
    SheetEntry entry;
    entry.sheet = make_sheet({});
    entry.world = WorldPose{1.5, -0.7, 0.6};
    const SheetPlace place{&entry};
    Eye eye;
    const SpaceSighting seen = eye.look_at(hand_at(0.4), 0);
    SpacePose pose;
    pose.camera = seen.camera;
    pose.covariance = seen.covariance;
    pose.second = SecondPose{mirrored(seen.camera), -50};
    SpaceTracker tracker;
    const auto sighting = world_sighting(pose, place, 5);
    ASSERT_TRUE(sighting);
    const auto motion = motion_of(tracker.update(*sighting));
    ASSERT_TRUE(motion);
    const CameraInWorld expected =
        in_world(on_sheet(pose.camera, entry), pose.covariance, *entry.world);
    EXPECT_NEAR(motion->pose.x_m, expected.x_m, 1e-9);
    EXPECT_NEAR(motion->pose.y_m, expected.y_m, 1e-9);
    EXPECT_NEAR(motion->pose.z_m, expected.z_m, 1e-9);
    EXPECT_NEAR(rotation_of({0, 0, 0, motion->pose.rotation})
                    .angularDistance(rotation_of({0, 0, 0, expected.rotation})),
                0, 1e-7);
    EXPECT_LT((matrix_of(motion->pose.covariance) - matrix_of(expected.covariance)).norm(),
              1e-9 * matrix_of(expected.covariance).norm());
    const CameraInWorld second =
        in_world(on_sheet(pose.second->camera, entry), pose.covariance, *entry.world);
    EXPECT_NEAR(sighting->second->camera.x_mm, 1000 * second.x_m, 1e-6);
    entry.world.reset();
    EXPECT_FALSE(world_sighting(pose, place, 5));
    EXPECT_FALSE(motion_of(SpaceTrack{}));
}

TEST(SpaceTrack, HasVelocitiesInTheWorld) {
    SpaceTracker tracker;
    Eye eye(0.1);
    for (int i = 0; i <= 100; ++i) {
        const CameraInSpace at =
            camera_of({30 * i / 100.0, 20 * i / 100.0, -kHeight_mm - 10 * i / 100.0},
                      Quaterniond::Identity());
        tracker.update(eye.look_at(at, i / 100.0));
    }
    const auto motion = motion_of(tracker.track());
    ASSERT_TRUE(motion);
    EXPECT_NEAR(motion->velocity_m_s[0], 0.030, 0.002);
    EXPECT_NEAR(motion->velocity_m_s[1], -0.020, 0.002);  // up
    EXPECT_NEAR(motion->velocity_m_s[2], 0.010, 0.002);   // away from the paper
    const SpaceCovariance& mm = tracker.track().velocity_covariance;
    EXPECT_NEAR(motion->velocity_covariance[0][0], 1e-6 * mm[0][0], 1e-9 * mm[0][0]);
    EXPECT_NEAR(motion->velocity_covariance[0][1], -1e-6 * mm[0][1], 1e-12);
    EXPECT_NEAR(motion->velocity_covariance[4][4], mm[4][4], 1e-12);
}

TEST(SpaceTrack, IsLostAfterAGap) {
    SpaceTracker tracker;
    Eye eye;
    tracker.update(eye.look_at(hand_at(0), 0));
    EXPECT_FALSE(tracker.update(200'000).is_lost);
    EXPECT_TRUE(tracker.update(200'001).is_lost);
    EXPECT_FALSE(tracker.predict(300'000));
    EXPECT_TRUE(tracker.update(eye.look_at(hand_at(1), 1)).is_new);
    // A change of the plane and a step back in time each start a new track.
    SpaceSighting other = eye.look_at(hand_at(1.01), 1.01);
    other.plane = 7;
    EXPECT_TRUE(tracker.update(other).is_new);
    other.time_us -= 20'000;
    EXPECT_TRUE(tracker.update(other).is_new);
}

}  // namespace
}  // namespace dotpose
