#include <algorithm>
#include <array>
#include <cmath>

#include "dotpose/track.hpp"
#include "locator.hpp"
#include "object.hpp"

namespace {

using namespace dotpose;

using TrackerObject = c::Object<Tracker, 0xD07C0004>;

constexpr std::size_t kFirstBytes = 88;
/// Times are at most 2^kLatest_us µs in magnitude, and coordinates are at most 2^kFarthest_nm nm.
/// The difference of two times or of two coordinates therefore does not overflow.
constexpr int kLatest_us = 62;
constexpr int kFarthest_nm = 60;

dotpose_track_options options_of(const TrackOptions& o) {
    return {sizeof(dotpose_track_options),
            o.acceleration_mm_s2,
            o.angular_acceleration_rad_s2,
            o.max_acceleration_mm_s2,
            o.max_angular_acceleration_rad_s2,
            o.max_speed_mm_s,
            o.max_turn_rad_s,
            o.gate_sigmas,
            o.confirmations,
            o.still_mm,
            o.still_rad,
            o.min_sigma_mm,
            o.min_sigma_rad,
            o.max_p_wrong_log2,
            o.max_weak_p_wrong_log2,
            o.spacing_mm,
            o.lost_after_us,
            o.stationary_after_us,
            o.max_sigma_mm,
            0};
}

TrackOptions options_of(const dotpose_track_options& o) {
    return {.acceleration_mm_s2 = o.acceleration_mm_s2,
            .angular_acceleration_rad_s2 = o.angular_acceleration_rad_s2,
            .max_acceleration_mm_s2 = o.max_acceleration_mm_s2,
            .max_angular_acceleration_rad_s2 = o.max_angular_acceleration_rad_s2,
            .max_speed_mm_s = o.max_speed_mm_s,
            .max_turn_rad_s = o.max_turn_rad_s,
            .gate_sigmas = o.gate_sigmas,
            .confirmations = o.confirmations,
            .lost_after_us = o.lost_after_us,
            .max_sigma_mm = o.max_sigma_mm,
            .still_mm = o.still_mm,
            .still_rad = o.still_rad,
            .stationary_after_us = o.stationary_after_us,
            .min_sigma_mm = o.min_sigma_mm,
            .min_sigma_rad = o.min_sigma_rad,
            .max_p_wrong_log2 = o.max_p_wrong_log2,
            .max_weak_p_wrong_log2 = o.max_weak_p_wrong_log2,
            .spacing_mm = o.spacing_mm};
}

/// Returns true if a number is in [0, 1e9]. Squares of numbers in this range do not overflow.
bool is_size(float value) {
    return value >= 0 && value <= 1e9F;
}

bool are_good(const dotpose_track_options& o) {
    const std::array sizes{o.acceleration_mm_s2,
                           o.angular_acceleration_rad_s2,
                           o.max_acceleration_mm_s2,
                           o.max_angular_acceleration_rad_s2,
                           o.max_speed_mm_s,
                           o.max_turn_rad_s,
                           o.gate_sigmas,
                           o.still_mm,
                           o.still_rad,
                           o.min_sigma_mm,
                           o.min_sigma_rad,
                           o.max_sigma_mm};
    return std::all_of(sizes.begin(), sizes.end(), is_size) && is_size(o.spacing_mm) &&
           o.spacing_mm > 0 && o.confirmations >= 1 && o.max_p_wrong_log2 <= 0 &&
           o.max_weak_p_wrong_log2 <= -1 && o.lost_after_us >= 0 && o.stationary_after_us >= 0;
}

/// Reads a sighting. Returns BAD_VALUE if a member is NaN or so large that sums could overflow.
dotpose_status to_core(const dotpose_sighting& given, Sighting& sighting) {
    constexpr float kMaxCovariance = 1e12F;
    const auto is_finite = [](float value) { return std::fabs(value) <= kMaxCovariance; };
    const float* of_diagonal = given.covariance;
    if (!c::is_within_range(given.time_us, kLatest_us) ||
        !c::is_within_range(given.x_nm, kFarthest_nm) ||
        !c::is_within_range(given.y_nm, kFarthest_nm) ||
        !std::all_of(std::begin(given.covariance), std::end(given.covariance), is_finite) ||
        of_diagonal[0] < 0 || of_diagonal[4] < 0 || of_diagonal[8] < 0 || given.spacing_nm < 0 ||
        !c::is_one_of(given.is_y_up, 1)) {
        return DOTPOSE_BAD_VALUE;
    }
    sighting = {.time_us = given.time_us,
                .x_nm = given.x_nm,
                .y_nm = given.y_nm,
                .theta_bam = given.theta_bam,
                .plane = given.plane,
                .p_wrong_log2 = given.p_wrong_log2,
                .spacing_nm = given.spacing_nm,
                .is_y_up = given.is_y_up != 0};
    for (std::size_t i = 0; i < 9; ++i)
        sighting.covariance[i / 3][i % 3] = given.covariance[i];
    return DOTPOSE_OK;
}

void to_c(const Sighting& sighting, dotpose_sighting& result) {
    result.time_us = sighting.time_us;
    result.x_nm = sighting.x_nm;
    result.y_nm = sighting.y_nm;
    result.theta_bam = sighting.theta_bam;
    result.plane = sighting.plane;
    for (std::size_t i = 0; i < 9; ++i)
        result.covariance[i] = sighting.covariance[i / 3][i % 3];
    result.p_wrong_log2 = sighting.p_wrong_log2;
    result.spacing_nm = sighting.spacing_nm;
    result.is_y_up = sighting.is_y_up ? 1 : 0;
}

std::uint32_t bits_of(const TrackEvents& events) {
    const auto bit = [](bool is_set, std::uint32_t value) { return is_set ? value : 0; };
    return bit(events.fix, DOTPOSE_EVENT_FIX) | bit(events.lost, DOTPOSE_EVENT_LOST) |
           bit(events.kidnapped, DOTPOSE_EVENT_KIDNAPPED) |
           bit(events.stationary, DOTPOSE_EVENT_STATIONARY) |
           bit(events.moving, DOTPOSE_EVENT_MOVING);
}

void to_c(const Track& track, dotpose_track& result) {
    const TrackedPose& pose = track.pose;
    result.time_us = pose.time_us;
    result.x_mm = pose.x_mm();
    result.y_mm = pose.y_mm();
    result.theta_rad = pose.theta_rad();
    result.x_nm = pose.x_nm;
    result.y_nm = pose.y_nm;
    result.theta_bam = pose.theta_bam;
    result.plane = pose.plane;
    result.vx_mm_s = pose.vx_mm_s;
    result.vy_mm_s = pose.vy_mm_s;
    result.turn_rad_s = pose.turn_rad_s;
    result.p_wrong_log2 = track.p_wrong_log2;
    result.verdict = static_cast<std::int32_t>(track.verdict);
    result.is_lost = track.is_lost ? 1 : 0;
    result.is_stationary = track.is_stationary ? 1 : 0;
    result.events = bits_of(track.events);
    for (std::size_t i = 0; i < 36; ++i)
        result.covariance[i] = pose.covariance[i / 6][i % 6];
}

dotpose_status update(dotpose_tracker* tracker, int64_t time_us, const dotpose_sighting* sighting,
                      const MeasuredMotion* motion, dotpose_track* track) {
    if (track == nullptr) return DOTPOSE_NULL_POINTER;
    Tracker* found = nullptr;
    dotpose_status status = TrackerObject::find(tracker, found);
    if (status != DOTPOSE_OK) return status;
    if (!c::is_within_range(time_us, kLatest_us)) return DOTPOSE_BAD_VALUE;
    Sighting read;
    if (sighting != nullptr) status = to_core(*sighting, read);
    if (status != DOTPOSE_OK) return status;
    const Sighting* seen = sighting == nullptr ? nullptr : &read;
    to_c(motion == nullptr ? found->update(time_us, seen) : found->update(time_us, seen, *motion),
         *track);
    return DOTPOSE_OK;
}

}  // namespace

extern "C" {

dotpose_status dotpose_track_options_init(dotpose_track_options* options, size_t bytes) {
    return c::write_sized(options_of(TrackOptions{}), kFirstBytes, options, bytes);
}

dotpose_status dotpose_tracker_init(dotpose_tracker* tracker, const dotpose_track_options* given) {
    if (tracker == nullptr) return DOTPOSE_NULL_POINTER;
    *tracker = {};
    dotpose_track_options read = options_of(TrackOptions{});
    const dotpose_status status = c::read_sized(given, kFirstBytes, read);
    if (status != DOTPOSE_OK) return status;
    if (!are_good(read)) return DOTPOSE_BAD_ARGUMENT;
    TrackerObject::make(tracker, options_of(read));
    return DOTPOSE_OK;
}

dotpose_status dotpose_sighting_of(const dotpose_fix* fix, int64_t time_us,
                                   dotpose_sighting* sighting) {
    if (sighting == nullptr) return DOTPOSE_NULL_POINTER;
    Fix read;
    const dotpose_status status = c::to_core_ok(fix, read);
    if (status != DOTPOSE_OK) return status;
    constexpr std::int32_t kMaxSpacing_nm = 20'000'000;
    if (read.spacing_nm <= 0 || read.spacing_nm > kMaxSpacing_nm ||
        !c::is_within_range(time_us, kLatest_us)) {
        return DOTPOSE_BAD_VALUE;
    }
    to_c(sighting_of(read, time_us), *sighting);
    return DOTPOSE_OK;
}

dotpose_status dotpose_tracker_update(dotpose_tracker* tracker, int64_t time_us,
                                      const dotpose_sighting* sighting, dotpose_track* track) {
    return update(tracker, time_us, sighting, nullptr, track);
}

dotpose_status dotpose_tracker_update_moved(dotpose_tracker* tracker, int64_t time_us,
                                            const dotpose_sighting* sighting,
                                            const dotpose_measured_motion* motion,
                                            dotpose_track* track) {
    if (motion == nullptr) return DOTPOSE_NULL_POINTER;
    MeasuredMotion read;
    const dotpose_status status = c::to_core(*motion, read);
    return status != DOTPOSE_OK ? status : update(tracker, time_us, sighting, &read, track);
}

dotpose_status dotpose_tracker_predict(const dotpose_tracker* tracker, int64_t time_us,
                                       const dotpose_fix* newest, const dotpose_sighting* seen,
                                       const dotpose_locator* locator,
                                       dotpose_prediction* prediction) {
    if (seen == nullptr || prediction == nullptr) return DOTPOSE_NULL_POINTER;
    const Tracker* found = nullptr;
    dotpose_status status = TrackerObject::find(tracker, found);
    Fix fix;
    Sighting sighting;
    if (status == DOTPOSE_OK) status = c::check(locator);
    if (status == DOTPOSE_OK) status = c::to_core_ok(newest, fix);
    if (status == DOTPOSE_OK) status = to_core(*seen, sighting);
    if (status != DOTPOSE_OK) return status;
    if (!c::is_within_range(time_us, kLatest_us) || !c::can_move(Prediction::like(fix)))
        return DOTPOSE_BAD_VALUE;
    c::to_c(found->predict(time_us, fix, sighting, locator->locator->options()), *prediction);
    return DOTPOSE_OK;
}
}
