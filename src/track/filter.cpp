#include "track/filter.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::track {
namespace {

/// Time constant of the acceleration decay.
constexpr float kHold_s = 0.5F;

/// Factor by which each sighting raises or lowers the agility. The agility scales the process noise
/// (see filter.hpp). Because the factor is the same in both directions, the agility settles where
/// consecutive innovations have equal signs as often as opposite signs, as in a filter with the
/// correct noise variance.
constexpr float kAgility_step = 1.5F;
constexpr float kMinAgility = 1e-6F;
/// Maximum innovation, in standard deviations, that is attributed to noise.
constexpr float kSurprise = 4;
/// Number of sightings over which the scatter is averaged. The scatter is the ratio of the squared
/// innovations to their expected variances.
constexpr float kScatter_sightings = 32;
constexpr float kMinScatter = 0.01F;
constexpr float kMaxScatter = 9;

/// Upper bound on the rounding error when two variances are subtracted, relative to the larger
/// variance.
constexpr float kRounding = 4e-6F;

float squared(float value) {
    return value * value;
}

/// Returns the covariance of a sighting plus the variances due to printing errors.
Matrix3 noise_of(const Sighting& sighting, const TrackOptions& options) {
    Matrix3 noise = sighting.covariance;
    noise[0][0] += squared(options.min_sigma_mm);
    noise[1][1] += squared(options.min_sigma_mm);
    noise[2][2] += squared(options.min_sigma_rad);
    return noise;
}

std::int32_t turned(std::int32_t theta_bam, float angle_rad) {
    const auto turn = static_cast<std::int64_t>(angle_rad / kRad_per_bam);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::int64_t{theta_bam} + turn));
}

/// Adds `step` to the state. The pose in `step` is in mm and rad.
void move(MotionEstimate& motion, const Vector9& step) {
    constexpr float kNm_per_mm = 1e6F;
    TrackedPose& pose = motion.pose;
    pose.x_nm += static_cast<std::int64_t>(step[0] * kNm_per_mm);
    pose.y_nm += static_cast<std::int64_t>(step[1] * kNm_per_mm);
    pose.theta_bam = turned(pose.theta_bam, step[2]);
    pose.vx_mm_s += step[3];
    pose.vy_mm_s += step[4];
    pose.turn_rad_s += step[5];
    for (std::size_t i = 0; i < 3; ++i)
        motion.acceleration[i] += step[i + 6];
}

/// Returns the fraction of the acceleration that remains after `dt_s` seconds.
float kept(float dt_s) {
    return kHold_s / (kHold_s + dt_s);
}

/// Advances a state, or one row or column of its covariance, by `dt_s`. `at(i)` must return a
/// reference to element i. Applies the decay of the acceleration first, and then treats the
/// acceleration as constant over the interval.
template <typename State>
void advance(const State& at, float dt_s) {
    for (std::size_t i = 0; i < 3; ++i) {
        at(i + 6) *= kept(dt_s);
        at(i) += dt_s * at(i + 3) + dt_s * dt_s / 2 * at(i + 6);
        at(i + 3) += dt_s * at(i + 6);
    }
}

/// Returns the steady-state standard deviation of the acceleration along an axis, for an agility of
/// 1.
float spread(std::size_t axis, const TrackOptions& options) {
    return axis < 2 ? options.acceleration_mm_s2 : options.angular_acceleration_rad_s2;
}

/// Returns the variance that process noise adds to the acceleration within `dt_s`, for an agility
/// of 1.
float push(std::size_t axis, float dt_s, const TrackOptions& options) {
    return squared(spread(axis, options)) * (1 - squared(kept(dt_s)));
}

/// Adds process noise along one axis to the covariance. The noise changes position, velocity and
/// acceleration in proportion to `effect`.
void add_noise(Covariance9& covariance, std::size_t axis, float variance, const Vector3& effect) {
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            covariance[axis + 3 * i][axis + 3 * j] += variance * effect[i] * effect[j];
    }
}

/// Sets the pose covariance. If sightings scatter less than their covariances predict, part of
/// their error is common to all of them. Averaging does not reduce this common error, so the pose
/// covariance includes it in full.
void set_pose_covariance(MotionEstimate& motion) {
    const float common = std::max(1 - motion.scatter, 0.0F);
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
            motion.pose.covariance[i][j] = motion.scatter * motion.covariance[i][j] +
                                           (i < 3 && j < 3 ? common * motion.noise[i][j] : 0);
        }
    }
}

/// Returns the inverse of a symmetric positive definite matrix.
Matrix3 inverse(const Matrix3& m) {
    Matrix3 cofactors{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t a = (i + 1) % 3;
            const std::size_t b = (i + 2) % 3;
            const std::size_t c = (j + 1) % 3;
            const std::size_t d = (j + 2) % 3;
            cofactors[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    }
    const float determinant =
        m[0][0] * cofactors[0][0] + m[0][1] * cofactors[0][1] + m[0][2] * cofactors[0][2];
    for (Vector3& row : cofactors) {
        for (float& value : row)
            value /= determinant;
    }
    return cofactors;
}

/// Returns left * right. `right` may have any number of columns.
template <typename Left, typename Right>
Right product(const Left& left, const Right& right) {
    Right result{};
    for (std::size_t i = 0; i < left.size(); ++i) {
        for (std::size_t k = 0; k < right.size(); ++k) {
            for (std::size_t j = 0; j < right[k].size(); ++j)
                result[i][j] += left[i][k] * right[k][j];
        }
    }
    return result;
}

/// Updates the covariance P for a sighting: replaces P with (I - K H) P. K is the gain, and H
/// selects the pose from the state. S is the covariance of the innovation. `weighted` is S^-1 H P,
/// the transpose of K. `noise` is R, the covariance of the sighting.
void subtract_known(Covariance9& p, const std::array<Vector9, 3>& weighted, const Matrix3& noise) {
    const Covariance9 before = p;
    for (std::size_t i = 3; i < 9; ++i) {
        for (std::size_t j = 3; j <= i; ++j) {
            for (std::size_t k = 0; k < 3; ++k)
                p[i][j] -= before[i][k] * weighted[k][j];
            p[j][i] = p[i][j];
        }
        p[i][i] += kRounding * before[i][i];
    }
    // The upper three rows equal R S^-1 H P, a product without cancellation. If these rows were
    // computed by the subtraction above, they would lose all significant digits in single precision
    // after a long gap between sightings. The other elements must be computed by subtraction, so
    // the loop adds a bound on the rounding error to their diagonal elements.
    const auto upper = product(noise, weighted);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 9; ++j)
            p[i][j] = p[j][i] = upper[i][j];
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < i; ++j)
            p[i][j] = p[j][i] = (upper[i][j] + upper[j][i]) / 2;
    }
}

}  // namespace

TrackedPose pose_of(const Sighting& sighting) {
    TrackedPose pose;
    pose.time_us = sighting.time_us;
    pose.x_nm = sighting.x_nm;
    pose.y_nm = sighting.y_nm;
    pose.theta_bam = sighting.theta_bam;
    pose.plane = sighting.plane;
    return pose;
}

MotionEstimate started_at(const Sighting& sighting, const TrackOptions& options) {
    MotionEstimate motion;
    motion.pose = pose_of(sighting);
    motion.noise = noise_of(sighting, options);
    for (std::size_t i = 0; i < 3; ++i) {
        std::copy(motion.noise[i].begin(), motion.noise[i].end(), motion.covariance[i].begin());
        const float fastest = i < 2 ? options.max_speed_mm_s : options.max_turn_rad_s;
        motion.covariance[i + 3][i + 3] = squared(fastest / 2);
        motion.covariance[i + 6][i + 6] = squared(spread(i, options));
    }
    set_pose_covariance(motion);
    return motion;
}

MotionEstimate predicted(const MotionEstimate& motion, std::int64_t time_us,
                         const TrackOptions& options) {
    const float dt_s = static_cast<float>(time_us - motion.pose.time_us) * 1e-6F;
    MotionEstimate later = motion;
    later.pose.time_us = time_us;
    const TrackedPose& pose = motion.pose;
    const Vector3& a = motion.acceleration;
    const Vector9 before = {0, 0, 0, pose.vx_mm_s, pose.vy_mm_s, pose.turn_rad_s, a[0], a[1], a[2]};
    Vector9 step = before;
    advance([&](std::size_t i) -> float& { return step[i]; }, dt_s);
    for (std::size_t i = 0; i < 9; ++i)
        step[i] -= before[i];
    move(later, step);
    Covariance9& p = later.covariance;
    for (std::size_t j = 0; j < 9; ++j)
        advance([&](std::size_t i) -> float& { return p[i][j]; }, dt_s);
    for (std::size_t i = 0; i < 9; ++i)
        advance([&](std::size_t j) -> float& { return p[i][j]; }, dt_s);
    for (std::size_t i = 0; i < 3; ++i)
        add_noise(p, i, motion.agility[i] * push(i, dt_s, options), {dt_s * dt_s / 2, dt_s, 1});
    set_pose_covariance(later);
    return later;
}

namespace {

/// A measured motion, converted to the plane of the sightings.
struct PlaneMotion {
    Vector3 step{};       ///< mm, mm, rad
    Vector3 by_theta{};   ///< derivative of `step` with respect to theta
    Vector3 variances{};  ///< measurement variances, per axis
};

PlaneMotion in_plane(const MeasuredMotion& measured, std::int32_t theta_bam, bool is_y_up) {
    const float theta_rad = static_cast<float>(theta_bam) * kRad_per_bam;
    const float c = std::cos(theta_rad);
    const float s = std::sin(theta_rad);
    const float down_mm = is_y_up ? -measured.down_mm : measured.down_mm;
    const float variance_mm2 = squared(measured.sigma_mm);
    const float x = c * measured.right_mm - s * down_mm;
    const float y = s * measured.right_mm + c * down_mm;
    return {{x, y, is_y_up ? -measured.turn_rad : measured.turn_rad},
            {-y, x, 0},
            {variance_mm2, variance_mm2, squared(measured.sigma_rad)}};
}

}  // namespace

MotionEstimate carried(const MotionEstimate& motion, const MeasuredMotion& measured,
                       std::int64_t time_us, bool is_y_up, const TrackOptions& options) {
    const float dt_s = static_cast<float>(time_us - motion.pose.time_us) * 1e-6F;
    const PlaneMotion seen = in_plane(measured, motion.pose.theta_bam, is_y_up);
    // The agility is fitted to sightings and does not apply to the motion between sightings, so
    // this prediction uses an agility of 1.
    MotionEstimate later = motion;
    later.agility = {1, 1, 1};
    later = predicted(later, time_us, options);
    later.agility = motion.agility;
    // The odometry measures the new pose minus the old pose. Let e_new and e_old be the errors of
    // these poses. The error of the innovation is the odometry error plus
    //
    //     g = e_new - e_old - by_theta * e_old[2]
    //
    // The last term is due to the error of the old theta, because the measured displacement is
    // rotated by the old theta.
    std::array<Vector9, 3> with_old{};  // covariance between old pose and new state
    for (std::size_t k = 0; k < 3; ++k) {
        with_old[k] = motion.covariance[k];
        advance([&](std::size_t i) -> float& { return with_old[k][i]; }, dt_s);
    }
    std::array<Vector9, 3> with_g{};  // covariance between g and new state
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 9; ++i) {
            with_g[k][i] =
                later.covariance[k][i] - with_old[k][i] - seen.by_theta[k] * with_old[2][i];
        }
    }
    Matrix3 s{};  // covariance of the innovation: cov(g) plus the variances of the odometry
    for (std::size_t k = 0; k < 3; ++k) {
        Vector3 g_with_old{};  // covariance between g[k] and old pose
        for (std::size_t i = 0; i < 3; ++i) {
            g_with_old[i] = with_old[i][k] - motion.covariance[k][i] -
                            seen.by_theta[k] * motion.covariance[2][i];
        }
        for (std::size_t i = 0; i < 3; ++i)
            s[k][i] = with_g[k][i] - g_with_old[i] - seen.by_theta[i] * g_with_old[2];
        s[k][k] += seen.variances[k];
    }
    const auto weighted = product(inverse(s), with_g);  // the transpose of the gain
    const Vector3 expected = difference(motion.pose, later.pose);
    Vector9 step{};
    for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            step[i] += weighted[k][i] * (seen.step[k] - expected[k]);
    }
    move(later, step);
    const Covariance9 before = later.covariance;
    for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            for (std::size_t k = 0; k < 3; ++k)
                later.covariance[i][j] -= with_g[k][i] * weighted[k][j];
            later.covariance[j][i] = later.covariance[i][j];
        }
        later.covariance[i][i] += kRounding * before[i][i];
    }
    // Computes the pose covariance with a scatter of at least 1. A scatter below 1 applies only to
    // sightings, because odometry errors are independent of sighting errors.
    const float scatter = later.scatter;
    later.scatter = std::max(scatter, 1.0F);
    set_pose_covariance(later);
    later.scatter = scatter;
    return later;
}

Vector3 difference(const TrackedPose& a, const TrackedPose& b) {
    constexpr float kMm_per_nm = 1e-6F;
    const std::uint32_t turn =
        static_cast<std::uint32_t>(b.theta_bam) - static_cast<std::uint32_t>(a.theta_bam);
    return {static_cast<float>(b.x_nm - a.x_nm) * kMm_per_nm,
            static_cast<float>(b.y_nm - a.y_nm) * kMm_per_nm,
            static_cast<float>(static_cast<std::int32_t>(turn)) * kRad_per_bam};
}

Innovation innovation(const MotionEstimate& predicted, const Sighting& sighting,
                      const TrackOptions& options) {
    Innovation result;
    result.difference = difference(predicted.pose, pose_of(sighting));
    result.covariance = noise_of(sighting, options);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result.covariance[i][j] += predicted.covariance[i][j];
    }
    return result;
}

MotionEstimate fitted(const MotionEstimate& predicted, const Sighting& sighting, float dt_s,
                      const TrackOptions& options) {
    const Vector3 differences = difference(predicted.pose, pose_of(sighting));
    const Matrix3 noise = noise_of(sighting, options);
    MotionEstimate motion = predicted;
    const Vector3 effect = {dt_s * dt_s / 2, dt_s, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        const float moved = differences[i];
        const float repeated = moved * motion.innovation[i];
        motion.innovation[i] = moved;
        const float old = motion.agility[i];
        const float pushed = push(i, dt_s, options);
        const float possible = squared(moved / kSurprise) / motion.scatter;
        const auto surprise = [&] { return possible - motion.covariance[i][i] - noise[i][i]; };
        // If the filter lags behind the robot, consecutive innovations have the same sign, so the
        // agility is increased. If the filter follows the noise, consecutive innovations have
        // opposite signs, so the agility is decreased.
        const float agility = repeated > 0 ? old * kAgility_step : old / kAgility_step;
        const float needed = old + surprise() / (pushed * squared(effect[0]));
        motion.agility[i] = std::clamp(std::max(agility, needed), kMinAgility, 1.0F);
        add_noise(motion.covariance, i, (motion.agility[i] - old) * pushed, effect);
        // An innovation that the agility does not explain may be caused by a collision or an
        // outlier. The first such innovation therefore increases only the variance of the position.
        // A second such innovation in the same direction indicates a collision, which changes the
        // velocity abruptly. It therefore also increases the variance of the velocity.
        if (surprise() > 0) {
            const bool is_hit = repeated > squared(moved) / 2;
            add_noise(motion.covariance, i, surprise(), {1, is_hit ? 1 / dt_s : 0, 0});
        }
    }
    return motion;
}

MotionEstimate corrected(const MotionEstimate& predicted, const Sighting& sighting,
                         const TrackOptions& options) {
    const Innovation found = innovation(predicted, sighting, options);
    const Matrix3 inverse_s = inverse(found.covariance);
    std::array<Vector9, 3> pose_rows{};
    std::copy_n(predicted.covariance.begin(), 3, pose_rows.begin());
    // S^-1 H P, the transpose of the gain K.
    const auto weighted = product(inverse_s, pose_rows);

    MotionEstimate motion = predicted;
    Vector9 step{};
    float distance = 0;  // squared Mahalanobis distance of the innovation, expected value 3
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 9; ++i)
            step[i] += weighted[k][i] * found.difference[k];
        for (std::size_t i = 0; i < 3; ++i)
            distance += found.difference[i] * inverse_s[i][k] * found.difference[k];
    }
    move(motion, step);
    motion.noise = noise_of(sighting, options);
    subtract_known(motion.covariance, weighted, motion.noise);
    motion.scatter +=
        (std::clamp(distance / 3, kMinScatter, kMaxScatter) - motion.scatter) / kScatter_sightings;
    set_pose_covariance(motion);
    return motion;
}

}  // namespace dotpose::track
