// Kalman filter for the pose of a camera in space. The state consists of the pose, the velocities
// and the accelerations. The rotation R of the pose is on a manifold: its error is a small rotation
// vector e, and the corrected rotation is R * exp(e) (Sola, Deray, Atchuthan 2018).
#include "dotpose/tools/space_track.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace dotpose {

using namespace space_track;

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector18 = Eigen::Matrix<double, 18, 1>;
using Matrix18 = Eigen::Matrix<double, 18, 18>;

/// Change in log(agility) after two consecutive innovations with equal signs (increase) or with
/// opposite signs (decrease). If both changes had the same magnitude, as in the planar tracker, the
/// normalised squared errors of individual axes would be up to 1.4 instead of 1 at 200 frames per
/// second (tests/unit/follow/space_track_test.cpp).
constexpr double kAgilityIncrease = 0.451;
constexpr double kAgilityDecrease = -0.405;
/// Change in log(agility) for each unit by which the squared normalised innovation exceeds its
/// expected value of 1. `dotpose_tables space_track` shows the effect.
constexpr double kAgilityGain = 0.2;
constexpr double kMinAgility = 1e-6;
/// Forgetting factor for the accumulated information about the fraction of independent errors. It
/// is applied once per sighting, so the fraction is averaged over about 50 sightings.
constexpr double kInformationKept = 0.98;
/// Minimum fraction of independent errors. With a minimum of 0.01, the positions in `dotpose_tables
/// space_track` are 0.3 to 0.6 % more accurate, but the velocities are up to 18 % less accurate.
constexpr double kMinIndependent = 0.05;
/// Maximum change in log(fraction of independent errors) per sighting.
constexpr double kMaxFractionStep = 0.5;
/// Innovation limit, in standard deviations. A larger innovation is not attributed to noise, and
/// resets the agility to 1.
constexpr double kSurprise = 4;
/// Minimum value of 2 ln(r), where r is the likelihood ratio of the two poses of an ambiguous
/// sighting. The value corresponds to r = 1000. If r is smaller, the track does not decide between
/// the poses.
constexpr double kMinContrast = 13.8;

Eigen::Map<const Vector6> vector_of(const std::array<double, 6>& values) {
    return Eigen::Map<const Vector6>(values.data());
}
Eigen::Map<Vector6> vector_of(std::array<double, 6>& values) {
    return Eigen::Map<Vector6>(values.data());
}
Eigen::Map<Matrix18> covariance_of(Motion& motion) {
    return Eigen::Map<Matrix18>(motion.covariance.data());
}
Eigen::Map<const Matrix18> covariance_of(const Motion& motion) {
    return Eigen::Map<const Matrix18>(motion.covariance.data());
}

Quaterniond rotation_of(const CameraInSpace& camera) {
    const Quaternion& q = camera.rotation;
    return {q.w, q.x, q.y, q.z};
}

Quaterniond exponential(const Vector3d& vector) {
    const double angle = vector.norm();
    if (angle < 1e-12) return Quaterniond(1, vector.x() / 2, vector.y() / 2, vector.z() / 2);
    return Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

Vector3d logarithm(const Quaterniond& rotation) {
    const Eigen::AngleAxisd turn(rotation);
    return std::remainder(turn.angle(), 2 * std::numbers::pi) * turn.axis();
}

/// Adds a step in position and rotation to a pose.
void move(CameraInSpace& camera, const Vector6& step) {
    camera.x_mm += step[0];
    camera.y_mm += step[1];
    camera.z_mm += step[2];
    Quaterniond rotation = (rotation_of(camera) * exponential(step.tail<3>())).normalized();
    if (rotation.w() < 0) rotation.coeffs() = -rotation.coeffs();
    camera.rotation = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
}

/// Returns b - a.
Vector6 difference(const CameraInSpace& a, const CameraInSpace& b) {
    Vector6 result;
    result << b.x_mm - a.x_mm, b.y_mm - a.y_mm, b.z_mm - a.z_mm,
        logarithm(rotation_of(a).conjugate() * rotation_of(b));
    return result;
}

double spread(Eigen::Index axis, const SpaceTrackOptions& options) {
    return axis < 3 ? options.acceleration_mm_s2 : options.angular_acceleration_rad_s2;
}

Matrix6 matrix_of(const SpaceCovariance& covariance) {
    Matrix6 matrix;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            matrix(Eigen::Index(i), Eigen::Index(j)) = covariance[i][j];
    }
    return matrix;
}

/// Returns the matrix that converts from the axes of `Motion::agility` to position and rotation. In
/// a view of a plane, the point in front of the camera is measured more accurately than the camera
/// position. The position error is therefore mostly the rotation error multiplied by a lever arm.
/// The lever arm is the regression of the position on the rotation. `noise` is the covariance of a
/// sighting.
Matrix6 lever_of(const Matrix6& noise) {
    Matrix6 result = Matrix6::Identity();
    const Matrix3d rotation = noise.bottomRightCorner<3, 3>();
    result.topRightCorner<3, 3>() =
        rotation.ldlt().solve(noise.bottomLeftCorner<3, 3>()).transpose();
    return result;
}

Motion started_at(const SpaceSighting& sighting, const SpaceTrackOptions& options) {
    Motion motion;
    motion.time_us = sighting.time_us;
    motion.camera = sighting.camera;
    motion.noise = sighting.covariance;
    auto covariance = covariance_of(motion);
    covariance.topLeftCorner<6, 6>() = matrix_of(sighting.covariance);
    for (Eigen::Index i = 0; i < 6; ++i) {
        const double speed = i < 3 ? options.speed_mm_s : options.turn_rad_s;
        covariance(6 + i, 6 + i) = speed * speed;
        covariance(12 + i, 12 + i) = spread(i, options) * spread(i, options);
    }
    return motion;
}

/// Predicts the state at a later time. The acceleration is reduced by a factor that depends on the
/// length of the interval, and is then assumed to be constant.
Motion predicted(const Motion& motion, std::int64_t time_us, const SpaceTrackOptions& options) {
    const double dt_s = static_cast<double>(time_us - motion.time_us) * 1e-6;
    const double kept = options.hold_s / (options.hold_s + dt_s);
    Motion later = motion;
    later.time_us = time_us;
    vector_of(later.acceleration) *= kept;
    const Vector6 step =
        dt_s * vector_of(motion.velocity) + dt_s * dt_s / 2 * vector_of(later.acceleration);
    vector_of(later.velocity) += dt_s * vector_of(later.acceleration);
    move(later.camera, step);
    Matrix18 by_state = Matrix18::Identity();
    by_state.block<3, 3>(3, 3) = exponential(step.tail<3>()).conjugate().toRotationMatrix();
    by_state.block<6, 6>(0, 6) = dt_s * Matrix6::Identity();
    by_state.block<6, 6>(0, 12) = dt_s * dt_s / 2 * kept * Matrix6::Identity();
    by_state.block<6, 6>(6, 12) = dt_s * kept * Matrix6::Identity();
    by_state.block<6, 6>(12, 12) *= kept;
    auto covariance = covariance_of(later);
    covariance = (by_state * covariance * by_state.transpose()).eval();
    Matrix6 pushed = Matrix6::Zero();
    for (Eigen::Index axis = 0; axis < 6; ++axis) {
        pushed(axis, axis) = motion.agility[static_cast<std::size_t>(axis)] *
                             spread(axis, options) * spread(axis, options) * (1 - kept * kept);
    }
    const Matrix6 lever = lever_of(matrix_of(motion.noise));
    pushed = (lever * pushed * lever.transpose()).eval();
    const Vector3d effect(dt_s * dt_s / 2, dt_s, 1);
    for (Eigen::Index i = 0; i < 3; ++i) {
        for (Eigen::Index j = 0; j < 3; ++j)
            covariance.block<6, 6>(6 * i, 6 * j) += pushed * effect[i] * effect[j];
    }
    return later;
}

/// Returns the normalised squared innovation of a pose. Uses an agility of 1 instead of the adapted
/// agility, so that the start of a manoeuvre is not rejected.
double squared_innovation(const Motion& motion, const SpaceSighting& sighting,
                          const CameraInSpace& camera, const SpaceTrackOptions& options) {
    Motion agile = motion;
    agile.agility.fill(1);
    agile.noise = {};  // no lever
    agile = predicted(agile, sighting.time_us, options);
    const Matrix6 covariance =
        covariance_of(std::as_const(agile)).topLeftCorner<6, 6>() + matrix_of(sighting.covariance);
    const Vector6 innovation = difference(agile.camera, camera);
    return innovation.dot(covariance.ldlt().solve(innovation));
}

/// Adapts the agility to an innovation, using two criteria. Their weights depend on the fraction of
/// the innovation variance that is due to the prediction:
/// - If this fraction is small, the agility determines the gain of the filter. With the correct
///   gain, consecutive innovations have equal signs as often as opposite signs. Equal signs
///   therefore increase the agility, and opposite signs decrease it.
/// - If the fraction is large, the gain is about 1 regardless of the agility, and the agility
///   determines only the covariance of predictions. With the correct covariance, the mean square of
///   the normalised innovation is 1.
/// `noise` is the independent part of the sighting covariance.
void adapt_agility(Motion& motion, const Vector6& innovation, const Matrix6& covariance,
                   const Matrix6& noise) {
    for (std::size_t i = 0; i < 6; ++i) {
        const auto axis = static_cast<Eigen::Index>(i);
        const double product = innovation[axis] * motion.innovation[i];
        const double square = innovation[axis] * innovation[axis] / covariance(axis, axis);
        const double predicted = 1 - noise(axis, axis) / covariance(axis, axis);
        double& agility = motion.agility[i];
        const double by_sign = product == 0 ? 0 : product > 0 ? kAgilityIncrease : kAgilityDecrease;
        const double change = (1 - predicted) * by_sign + predicted * kAgilityGain * (square - 1);
        const bool is_surprise = square > kSurprise * kSurprise;
        agility = is_surprise ? 1 : std::clamp(agility * std::exp(change), kMinAgility, 1.0);
        motion.innovation[i] = innovation[axis];
    }
}

/// Adapts the fraction of independent errors to an innovation, using two criteria. With the correct
/// fraction, the derivative of the log-likelihood of the innovation has mean 0, and consecutive
/// innovations are uncorrelated. If the fraction is too large, the filter lags behind the
/// sightings, and innovations are too small or correlated. `noise` is the independent part of the
/// sighting covariance.
void adapt_fraction(Motion& motion, const Vector6& innovation, const Matrix6& covariance,
                    const Matrix6& noise) {
    const auto inverse = covariance.ldlt();
    const Vector6 weighted = inverse.solve(innovation);
    const Matrix6 ratio = inverse.solve(noise);
    const double derivative = (weighted.dot(noise * weighted) - ratio.trace()) / 2;
    const double correlation = weighted.dot(noise * vector_of(motion.weighted_innovation));
    double& information = motion.independent_information;
    information = kInformationKept * information + (ratio * ratio).trace() / 2;
    const double step = std::clamp((derivative - correlation) / std::max(information, 1.0),
                                   -kMaxFractionStep, kMaxFractionStep);
    motion.independent = std::clamp(motion.independent * std::exp(step), kMinIndependent, 1.0);
    vector_of(motion.weighted_innovation) = weighted;
}

/// Adapts the parameters of a motion to a pose. `guess` is the prediction for the pose.
void adapt(Motion& motion, const Motion& guess, const CameraInSpace& camera) {
    const Matrix6 noise = motion.independent * matrix_of(motion.noise);
    const Matrix6 covariance = covariance_of(guess).topLeftCorner<6, 6>() + noise;
    const Vector6 innovation = difference(guess.camera, camera);
    const Matrix6 axes = lever_of(noise).inverse();
    adapt_agility(motion, axes * innovation, axes * covariance * axes.transpose(),
                  axes * noise * axes.transpose());
    adapt_fraction(motion, innovation, covariance, noise);
}

/// Corrects a prediction with a sighting. `noise` is the independent part of the sighting
/// covariance.
void correct(Motion& motion, const CameraInSpace& camera, const Matrix6& noise) {
    auto covariance = covariance_of(motion);
    const Matrix6 s = covariance.topLeftCorner<6, 6>() + noise;
    const Eigen::Matrix<double, 18, 6> gain = s.ldlt().solve(covariance.topRows<6>()).transpose();
    const Vector18 step = gain * difference(motion.camera, camera);
    move(motion.camera, step.head<6>());
    vector_of(motion.velocity) += step.segment<6>(6);
    vector_of(motion.acceleration) += step.tail<6>();
    Matrix18 kept = Matrix18::Identity();
    kept.leftCols<6>() -= gain;
    covariance = (kept * covariance * kept.transpose() + gain * noise * gain.transpose()).eval();
}

/// Converts a motion to a SpaceTrack with verdict `none`. The covariance of the pose includes the
/// errors that are common to all sightings.
SpaceTrack track_of(const Motion& motion, std::uint32_t plane) {
    SpaceTrack track;
    track.is_lost = false;
    track.time_us = motion.time_us;
    track.plane = plane;
    track.camera = motion.camera;
    const auto covariance = covariance_of(motion);
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
            track.covariance[i][j] = covariance(Eigen::Index(i), Eigen::Index(j)) +
                                     (1 - motion.independent) * motion.noise[i][j];
            track.velocity_covariance[i][j] = covariance(Eigen::Index(6 + i), Eigen::Index(6 + j));
        }
    }
    std::copy_n(motion.velocity.begin(), 3, track.velocity_mm_s.begin());
    std::copy_n(motion.velocity.begin() + 3, 3, track.turn_rad_s.begin());
    return track;
}

bool is_ambiguous(const SpaceSighting& sighting) {
    return sighting.second && sighting.second->odds_log2 > SpacePose::kMaxOdds_log2;
}

}  // namespace

SpaceSighting sighting_of(const SpacePose& pose, std::int64_t time_us, std::uint32_t plane) {
    return {time_us, pose.camera, pose.covariance, pose.second, plane};
}

const char* name(SpaceVerdict verdict) noexcept {
    switch (verdict) {
        case SpaceVerdict::accepted:
            return "accepted";
        case SpaceVerdict::second_accepted:
            return "second_accepted";
        case SpaceVerdict::rejected:
            return "rejected";
        default:
            return "none";
    }
}

const SpaceTrack& SpaceTracker::update(const SpaceSighting& sighting) {
    const bool continues = !track_.is_lost && sighting.plane == track_.plane &&
                           sighting.time_us > track_.time_us &&
                           sighting.time_us - accepted_us_ <= options_.lost_after_us;
    if (!continues) {
        track_ = SpaceTrack{};
        track_.time_us = sighting.time_us;
        start(sighting);
        return track_;
    }
    if (!take(sighting)) reject(sighting);
    return track_;
}

const SpaceTrack& SpaceTracker::update(std::int64_t time_us) {
    const bool is_lost = track_.is_lost || time_us < track_.time_us ||
                         time_us - accepted_us_ > options_.lost_after_us;
    if (is_lost) {
        track_ = SpaceTrack{};
        track_.time_us = time_us;
    } else {
        track_ = track_of(predicted(motion_, time_us, options_), track_.plane);
    }
    return track_;
}

/// Starts a track, unless the sighting is ambiguous.
void SpaceTracker::start(const SpaceSighting& sighting) {
    rejected_.reset();
    rejections_ = 0;
    if (is_ambiguous(sighting)) {
        track_.verdict = SpaceVerdict::rejected;
        return;
    }
    motion_ = started_at(sighting, options_);
    accepted_us_ = sighting.time_us;
    track_ = track_of(motion_, sighting.plane);
    track_.is_new = true;
    track_.verdict = SpaceVerdict::accepted;
}

/// Corrects the track with the more likely pose of the sighting. Returns false if this pose is not
/// consistent with the track, or if neither pose of an ambiguous sighting is much more likely than
/// the other.
bool SpaceTracker::take(const SpaceSighting& sighting) {
    const double first = squared_innovation(motion_, sighting, sighting.camera, options_);
    SpaceVerdict verdict = SpaceVerdict::accepted;
    CameraInSpace camera = sighting.camera;
    double taken = first;
    if (is_ambiguous(sighting)) {
        const double second =
            squared_innovation(motion_, sighting, sighting.second->camera, options_);
        // Twice the log-likelihood ratio of the first pose to the second.
        const double contrast = second - first - 2 * std::numbers::ln2 * sighting.second->odds_log2;
        if (std::abs(contrast) < kMinContrast) return false;
        if (contrast < 0) {
            verdict = SpaceVerdict::second_accepted;
            camera = sighting.second->camera;
            taken = second;
        }
    }
    if (taken > options_.max_innovation) return false;
    motion_.noise = sighting.covariance;
    adapt(motion_, predicted(motion_, sighting.time_us, options_), camera);
    motion_ = predicted(motion_, sighting.time_us, options_);
    correct(motion_, camera, motion_.independent * matrix_of(sighting.covariance));
    accepted_us_ = sighting.time_us;
    rejected_.reset();
    rejections_ = 0;
    track_ = track_of(motion_, sighting.plane);
    track_.verdict = verdict;
    return true;
}

/// Counts successive rejected sightings that are each consistent with the previous one. Starts a
/// new track when `SpaceTrackOptions::confirmations` sightings have been counted.
void SpaceTracker::reject(const SpaceSighting& sighting) {
    update(sighting.time_us);
    track_.verdict = SpaceVerdict::rejected;
    if (is_ambiguous(sighting)) return;
    const bool is_consistent =
        rejected_ && squared_innovation(started_at(*rejected_, options_), sighting, sighting.camera,
                                        options_) <= options_.max_innovation;
    rejections_ = is_consistent ? rejections_ + 1 : 1;
    rejected_ = sighting;
    if (rejections_ >= options_.confirmations) start(sighting);
}

std::optional<SpaceTrack> SpaceTracker::predict(std::int64_t time_us) const {
    if (track_.is_lost || time_us < motion_.time_us) return std::nullopt;
    return track_of(predicted(motion_, time_us, options_), track_.plane);
}

}  // namespace dotpose
