#include "dotpose/track.hpp"

#include <algorithm>
#include <cmath>

#include "track/filter.hpp"

namespace dotpose {
namespace {

using namespace dotpose::track;

/// log2 of the number of hypotheses along one axis, rounded down. The hypotheses are all
/// combinations of kPositionsPerAxis positions, 63 sections and 4 turns.
constexpr int kHypotheses_log2 = 36;
static_assert((std::uint64_t{kPositionsPerAxis} * kSections * 4) >> kHypotheses_log2 == 1,
              "the number of hypotheses is rounded down to a power of two");

/// Period of the shortest sequence that encodes the position. Two positions that are closer
/// together than this period have different places in all sequences, so their bits agree only by
/// chance (docs/tracking.md).
constexpr int kMinSequencePeriod = 31;

float seconds(std::int64_t from_us, std::int64_t to_us) {
    return static_cast<float>(to_us - from_us) * 1e-6F;
}

/// Returns the maximum accepted differences from the prediction: `gate_sigmas` standard deviations
/// of the innovation, plus a dt^2 / 2, where a is the maximum acceleration, or the maximum angular
/// acceleration for the angle.
Vector3 gate(const Innovation& found, float dt, const TrackOptions& options) {
    Vector3 limits{};
    for (std::size_t i = 0; i < 3; ++i) {
        const float acceleration =
            i < 2 ? options.max_acceleration_mm_s2 : options.max_angular_acceleration_rad_s2;
        limits[i] =
            options.gate_sigmas * std::sqrt(found.covariance[i][i]) + acceleration * dt * dt / 2;
    }
    return limits;
}

bool is_within(const Vector3& difference, const Vector3& limits) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (std::fabs(difference[i]) > limits[i]) return false;
    }
    return true;
}

/// Returns true if a robot could have moved from `from` to `sighting` within the limits on speed
/// and turn rate, with a tolerance of `gate_sigmas` standard deviations.
bool is_reachable(const MotionEstimate& from, const Sighting& sighting,
                  const TrackOptions& options) {
    if (from.pose.plane != sighting.plane) return false;
    const float dt = seconds(from.pose.time_us, sighting.time_us);
    const Innovation found = innovation(from, sighting, options);
    const float slack_mm =
        options.gate_sigmas * std::sqrt(std::max(found.covariance[0][0], found.covariance[1][1]));
    const float slack_rad = options.gate_sigmas * std::sqrt(found.covariance[2][2]);
    const float x = found.difference[0];
    const float y = found.difference[1];
    return std::sqrt(x * x + y * y) <= options.max_speed_mm_s * dt + slack_mm &&
           std::fabs(found.difference[2]) <= options.max_turn_rad_s * dt + slack_rad;
}

/// Returns log2 of an upper bound on the probability that a sighting within the gate is wrong.
/// Returns 0, the trivial bound, if the gate is too large for the prediction to help.
int p_wrong_with_prior(const Sighting& sighting, const Vector3& limits,
                       const TrackOptions& options) {
    const float half = std::max(limits[0], limits[1]) / options.spacing_mm;
    if (!(half < static_cast<float>(kMinSequencePeriod / 2)) || limits[2] > 0.78F) return 0;
    const auto cells = static_cast<unsigned>(2 * half) + 2;
    int cells_log2 = 0;
    while ((1U << cells_log2) < cells)
        ++cells_log2;
    return std::min(sighting.p_wrong_log2 + cells_log2 - kHypotheses_log2, 0);
}

}  // namespace

const char* name(Verdict verdict) noexcept {
    constexpr std::array<const char*, kVerdictCount> kNames = {"none", "accepted", "with_prior",
                                                               "gated", "too_weak"};
    return kNames[static_cast<std::size_t>(verdict)];
}

Sighting sighting_of(const Fix& fix, std::int64_t time_us) {
    const std::int32_t spacing_nm = fix.spacing_nm;
    const auto nm = [spacing_nm](std::uint32_t cell, std::uint16_t fraction_q16) {
        return std::int64_t{cell} * spacing_nm + ((std::int64_t{fraction_q16} * spacing_nm) >> 16);
    };
    Sighting sighting;
    sighting.time_us = time_us;
    sighting.x_nm = nm(fix.cell.x, fix.fraction_x_q16);
    sighting.y_nm = nm(fix.cell.y, fix.fraction_y_q16);
    sighting.theta_bam = fix.theta_bam;
    sighting.plane = std::uint32_t{fix.section.u} * kSections + fix.section.v;
    sighting.p_wrong_log2 = fix.p_wrong_log2;
    sighting.spacing_nm = spacing_nm;
    const float spacing_mm = static_cast<float>(spacing_nm) * 1e-6F;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const float unit = (i < 2 ? spacing_mm : 1.0F) * (j < 2 ? spacing_mm : 1.0F);
            sighting.covariance[i][j] = fix.covariance[i][j] * unit;
        }
    }
    return sighting;
}

const Track& Tracker::update(std::int64_t time_us, const Sighting* sighting) {
    return update(time_us, sighting, nullptr);
}

const Track& Tracker::update(std::int64_t time_us, const Sighting* sighting,
                             const MeasuredMotion& motion) {
    return update(time_us, sighting, motion.is_usable() ? &motion : nullptr);
}

const Track& Tracker::update(std::int64_t time_us, const Sighting* sighting,
                             const MeasuredMotion* motion) {
    track_.events = {};
    if (has_frame_ && time_us <= newest_us_) return track_;
    has_frame_ = true;
    newest_us_ = time_us;
    track_.verdict = Verdict::none;
    track_.p_wrong_log2 = 0;
    MotionEstimate prediction;
    const float dt_s = seconds(last_.pose.time_us, time_us);
    if (was_seen_ && motion != nullptr && !track_.is_lost) {
        last_ = prediction = carried(last_, *motion, time_us, is_y_up_, options_);
    } else if (was_seen_) {
        prediction = predicted(last_, time_us, options_);
    }
    track_.pose = prediction.pose;
    if (sighting != nullptr) {
        is_y_up_ = sighting->is_y_up;
        track_.verdict = judge(prediction, *sighting, dt_s);
    }
    if (track_.verdict != Verdict::accepted && track_.verdict != Verdict::with_prior) {
        track_.p_wrong_log2 = 0;
    }
    if (!track_.is_lost && is_stale()) {
        track_.is_lost = track_.events.lost = true;
        track_.is_stationary = false;
    }
    if (!track_.is_lost) watch_motion();
    return track_;
}

bool Tracker::is_stale() const {
    const float sigma_mm = std::sqrt(std::max(last_.covariance[0][0], last_.covariance[1][1]));
    return newest_us_ - last_.pose.time_us >= options_.lost_after_us ||
           !(sigma_mm <= options_.max_sigma_mm);
}

Verdict Tracker::judge(const MotionEstimate& prediction, const Sighting& sighting, float dt_s) {
    const bool is_weak = sighting.p_wrong_log2 > options_.max_p_wrong_log2;
    track_.p_wrong_log2 = sighting.p_wrong_log2;
    bool is_possible = !was_seen_;
    if (track_.is_lost) {
        if (is_weak) return Verdict::too_weak;
        is_possible = is_possible || is_reachable(last_, sighting, options_);
        if (is_possible) restart(started_at(sighting, options_));
    } else {
        const Innovation found = innovation(prediction, sighting, options_);
        const Vector3 limits = gate(found, dt_s, options_);
        is_possible = last_.pose.plane == sighting.plane && is_within(found.difference, limits);
        if (is_weak) {
            track_.p_wrong_log2 = p_wrong_with_prior(sighting, limits, options_);
            if (!is_possible || sighting.p_wrong_log2 > options_.max_weak_p_wrong_log2 ||
                track_.p_wrong_log2 > options_.max_p_wrong_log2) {
                return Verdict::too_weak;
            }
        }
        if (is_possible) {
            last_ = corrected(fitted(prediction, sighting, dt_s, options_), sighting, options_);
            track_.pose = last_.pose;
        }
    }
    if (is_possible) {
        agreeing_ = 0;
        return is_weak ? Verdict::with_prior : Verdict::accepted;
    }
    if (is_confirmed(sighting)) {
        track_.events.kidnapped = true;
        restart(candidate_);
        return Verdict::accepted;
    }
    return Verdict::gated;
}

bool Tracker::is_confirmed(const Sighting& sighting) {
    if (agreeing_ > 0 && is_reachable(candidate_, sighting, options_)) {
        ++agreeing_;
        const float dt_s = seconds(candidate_.pose.time_us, sighting.time_us);
        const MotionEstimate expected = predicted(candidate_, sighting.time_us, options_);
        candidate_ = corrected(fitted(expected, sighting, dt_s, options_), sighting, options_);
    } else {
        agreeing_ = 1;
        candidate_ = started_at(sighting, options_);
    }
    return agreeing_ >= options_.confirmations;
}

void Tracker::restart(const MotionEstimate& motion) {
    track_.events.fix = track_.is_lost;
    track_.is_lost = false;
    // If the robot was at rest before it was lost, reports that it moved. A robot that was lifted
    // and put down elsewhere has moved, even if it is now at rest.
    track_.events.moving = track_.is_stationary;
    track_.is_stationary = false;
    was_seen_ = true;
    agreeing_ = 0;
    last_ = motion;
    track_.pose = rest_ = last_.pose;
}

void Tracker::watch_motion() {
    const TrackedPose& pose = track_.pose;
    if (!is_within(difference(rest_, pose),
                   {options_.still_mm, options_.still_mm, options_.still_rad})) {
        rest_ = pose;
        track_.events.moving = track_.events.moving || track_.is_stationary;
        track_.is_stationary = false;
    } else if (!track_.is_stationary &&
               pose.time_us - rest_.time_us >= options_.stationary_after_us) {
        track_.is_stationary = track_.events.stationary = true;
    }
}

}  // namespace dotpose
