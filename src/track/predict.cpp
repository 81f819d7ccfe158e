#include <algorithm>
#include <cmath>

#include "dotpose/track.hpp"
#include "track/filter.hpp"

namespace dotpose {
namespace {

using namespace dotpose::track;

/// Minimum standard deviations of a prediction. They are needed because the filter covariance
/// becomes too small when the robot rests for a long time. The dot search extends to three standard
/// deviations, that is, at least 3/32 of a spacing and 0.53 degrees.
constexpr std::int32_t kMinSigma_q16 = 65536 / 32;
constexpr std::int32_t kMinSigma_theta_bam = 1 << 21;
constexpr float kDeviations = 3;

/// Maximum predicted motion between two frames, in spacings. Real robots move less. The limit also
/// prevents overflow of integer sums.
constexpr float kMaxMotion = 2048;

/// Converts a vector from the sighting's plane to the pattern frame. The rotation between the two
/// frames follows from the angles of the image x axis in both frames.
std::array<float, 2> in_pattern(float x, float y, const Fix& fix, const Sighting& seen) {
    const auto pattern_bam = static_cast<std::uint32_t>(fix.theta_bam);
    const auto plane_bam = static_cast<std::uint32_t>(seen.theta_bam);
    const std::uint32_t turn_bam = seen.is_y_up ? pattern_bam + plane_bam : pattern_bam - plane_bam;
    if (seen.is_y_up) y = -y;
    const float turn_rad = static_cast<float>(static_cast<std::int32_t>(turn_bam)) * kRad_per_bam;
    const float c = std::cos(turn_rad);
    const float s = std::sin(turn_rad);
    return {c * x - s * y, s * x + c * y};
}

/// Returns sigma / unit as an integer, clamped to [min, max]. Returns `max` for NaN.
std::int32_t bounded(float sigma, float unit, std::int32_t min, std::int32_t max) {
    const float value = sigma / unit;
    if (!(value < static_cast<float>(max))) return max;
    return std::max(static_cast<std::int32_t>(value), min);
}

/// Returns the standard deviation of the predicted pose along an axis: the combined standard
/// deviation of the filter and the fix, plus a third of `unforeseen`. `unforeseen` is the largest
/// motion that the filter cannot predict. The locator searches within three standard deviations, so
/// its search includes this motion.
float sigma(const Covariance6& predicted, const Sighting& seen, std::size_t axis,
            float unforeseen) {
    return std::sqrt(predicted[axis][axis] + seen.covariance[axis][axis]) +
           unforeseen / kDeviations;
}

}  // namespace

const MotionEstimate* Tracker::following(const Sighting& seen) const {
    const auto ends_at = [&](const MotionEstimate& motion) {
        return motion.pose.time_us == seen.time_us && motion.pose.plane == seen.plane;
    };
    if (!track_.is_lost && ends_at(last_)) return &last_;
    return agreeing_ > 0 && ends_at(candidate_) ? &candidate_ : nullptr;
}

Prediction Tracker::predict(std::int64_t time_us, const Fix& newest, const Sighting& seen,
                            const DeviceOptions& options) const {
    const Prediction as_seen = Prediction::like(newest);
    const MotionEstimate* followed = following(seen);
    const std::int64_t last_us = seen.time_us;
    if (followed == nullptr || seen.spacing_nm <= 0 || time_us <= last_us) return as_seen;
    const auto gap_us = static_cast<std::uint64_t>(time_us) - static_cast<std::uint64_t>(last_us);
    if (gap_us >= static_cast<std::uint64_t>(options_.lost_after_us)) return as_seen;

    const TrackedPose expected = predicted(*followed, time_us, options_).pose;
    const Vector3 step = difference(pose_of(seen), expected);
    const float spacing_mm = static_cast<float>(seen.spacing_nm) * 1e-6F;
    const auto by = in_pattern(step[0] / spacing_mm, step[1] / spacing_mm, newest, seen);
    if (!(std::fabs(by[0]) < kMaxMotion && std::fabs(by[1]) < kMaxMotion)) return as_seen;

    const auto q16 = [](float spacings) { return static_cast<std::int32_t>(spacings * 65536); };
    const auto turn_bam =
        static_cast<std::uint32_t>(expected.theta_bam) - static_cast<std::uint32_t>(seen.theta_bam);
    const FixedVec centre_q8 = newest.pattern_from_image.centre_q8;
    Prediction next =
        moved(as_seen, options.code, {q16(by[0]), q16(by[1])},
              static_cast<std::int32_t>(seen.is_y_up ? 0U - turn_bam : turn_bam),
              {centre_q8.x + options.reference_dx_q8, centre_q8.y + options.reference_dy_q8});
    const float gap_s = static_cast<float>(gap_us) * 1e-6F;
    const float half_square = gap_s * gap_s / 2;
    const auto deviation = [&](std::size_t axis, float largest_acceleration) {
        return sigma(expected.covariance, seen, axis, largest_acceleration * half_square);
    };
    const float sigma_mm = std::max(deviation(0, options_.max_acceleration_mm_s2),
                                    deviation(1, options_.max_acceleration_mm_s2));
    next.sigma_q16 = bounded(sigma_mm, spacing_mm / 65536, kMinSigma_q16, as_seen.sigma_q16);
    next.sigma_theta_bam = bounded(deviation(2, options_.max_angular_acceleration_rad_s2),
                                   kRad_per_bam, kMinSigma_theta_bam, as_seen.sigma_theta_bam);
    return next;
}

}  // namespace dotpose
