#include "track/filter.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::track {
namespace {

float squared(float value) {
    return value * value;
}

/// Of what a sighting measures, with the least errors added.
Matrix3 noise_of(const Sighting& sighting, const TrackOptions& options) {
    Matrix3 noise = sighting.covariance;
    noise[0][0] += squared(options.least_sigma_mm);
    noise[1][1] += squared(options.least_sigma_mm);
    noise[2][2] += squared(options.least_sigma_rad);
    return noise;
}

std::int32_t turned(std::int32_t theta_bam, float angle_rad) {
    const auto turn = static_cast<std::int64_t>(angle_rad / kRad_per_bam);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::int64_t{theta_bam} + turn));
}

/// Moves the pose by a step in mm, mm and rad.
void move(TrackedPose& pose, const Vector3& step) {
    constexpr float kNm_per_mm = 1e6F;
    pose.x_nm += static_cast<std::int64_t>(step[0] * kNm_per_mm);
    pose.y_nm += static_cast<std::int64_t>(step[1] * kNm_per_mm);
    pose.theta_bam = turned(pose.theta_bam, step[2]);
}

/// Symmetric and positive definite, as covariances are: by cofactors.
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

/// left * right; right has any number of columns.
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

}  // namespace

TrackedPose started_at(const Sighting& sighting, const TrackOptions& options) {
    TrackedPose pose;
    pose.time_us = sighting.time_us;
    pose.x_nm = sighting.x_nm;
    pose.y_nm = sighting.y_nm;
    pose.theta_bam = sighting.theta_bam;
    pose.plane = sighting.plane;
    const Matrix3 noise = noise_of(sighting, options);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            pose.covariance[i][j] = noise[i][j];
        const float fastest = i < 2 ? options.max_speed_mm_s : options.max_turn_rad_s;
        pose.covariance[i + 3][i + 3] = squared(fastest / 2);
    }
    return pose;
}

TrackedPose predicted(const TrackedPose& pose, std::int64_t time_us, const TrackOptions& options) {
    const float dt = static_cast<float>(time_us - pose.time_us) * 1e-6F;
    TrackedPose later = pose;
    later.time_us = time_us;
    move(later, {pose.vx_mm_s * dt, pose.vy_mm_s * dt, pose.turn_rad_s * dt});
    Covariance6& p = later.covariance;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            p[i][j] += dt * p[i + 3][j];
    }
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            p[i][j] += dt * p[i][j + 3];
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const float spread =
            squared(i < 2 ? options.acceleration_mm_s2 : options.angular_acceleration_rad_s2);
        p[i][i] += spread * squared(dt * dt) / 4;
        p[i][i + 3] += spread * dt * dt * dt / 2;
        p[i + 3][i] = p[i][i + 3];
        p[i + 3][i + 3] += spread * dt * dt;
    }
    return later;
}

Innovation innovation(const TrackedPose& predicted, const Sighting& sighting,
                      const TrackOptions& options) {
    constexpr float kMm_per_nm = 1e-6F;
    Innovation result;
    const std::uint32_t turn = static_cast<std::uint32_t>(sighting.theta_bam) -
                               static_cast<std::uint32_t>(predicted.theta_bam);
    result.difference = {static_cast<float>(sighting.x_nm - predicted.x_nm) * kMm_per_nm,
                         static_cast<float>(sighting.y_nm - predicted.y_nm) * kMm_per_nm,
                         static_cast<float>(static_cast<std::int32_t>(turn)) * kRad_per_bam};
    result.covariance = noise_of(sighting, options);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result.covariance[i][j] += predicted.covariance[i][j];
    }
    return result;
}

TrackedPose corrected(const TrackedPose& predicted, const Sighting& sighting,
                      const TrackOptions& options) {
    const Innovation found = innovation(predicted, sighting, options);
    const Matrix3 inverse_s = inverse(found.covariance);
    const Covariance6& p = predicted.covariance;
    std::array<std::array<float, 6>, 3> pose_rows{};
    std::copy(p.begin(), p.begin() + 3, pose_rows.begin());
    const auto weighted = product(inverse_s, pose_rows);  // S^-1 H P, the transposed gain

    std::array<float, 6> step{};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            step[i] += weighted[k][i] * found.difference[k];
    }
    TrackedPose pose = predicted;
    move(pose, {step[0], step[1], step[2]});
    pose.vx_mm_s += step[3];
    pose.vy_mm_s += step[4];
    pose.turn_rad_s += step[5];

    // (I - K H) P. Its upper half equals R S^-1 H P, where nothing cancels: in single precision the
    // difference of nearly equal numbers would lose everything after a long gap.
    const auto upper = product(noise_of(sighting, options), weighted);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            pose.covariance[i][j] = pose.covariance[j][i] = upper[i][j];
    }
    for (std::size_t i = 3; i < 6; ++i) {
        for (std::size_t j = 3; j < 6; ++j) {
            for (std::size_t k = 0; k < 3; ++k)
                pose.covariance[i][j] -= p[i][k] * weighted[k][j];
        }
    }
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const float mean = (pose.covariance[i][j] + pose.covariance[j][i]) / 2;
            pose.covariance[i][j] = pose.covariance[j][i] = mean;
        }
    }
    return pose;
}

}  // namespace dotpose::track
