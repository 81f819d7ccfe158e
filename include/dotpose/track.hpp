/// Tracker: the state of a robot from frame to frame. Position, angle and velocities with their
/// covariance, by a filter that fits itself to how the robot moves; and events: `fix`, `lost`,
/// `kidnapped`, `stationary`, `moving`. docs/tracking.md explains both, and how weak fixes are
/// judged.
///
///     Tracker tracker;
///     for (;;) {
///         const Fix fix = locator.locate(image);
///         const bool ok = fix.status == Status::ok;
///         const Sighting sighting = sighting_of(fix, time_us);
///         const Track& track = tracker.update(time_us, ok ? &sighting : nullptr);
///     }
///
/// `predict` tells where the next frame will show the pattern; examples/follow_robot.cpp has such a
/// loop.
///
/// Frames: any plane in mm, as long as the sightings agree on it: the pattern frame, or the world
/// of a sheet file, where a robot may drive from sheet to sheet. Positions are whole nanometres,
/// which reach over the whole pattern plane (2.1e14 nm). Angles are binary, 2^31 is half a turn,
/// from +x towards +y. Velocities: mm/s along x and y, rad/s.
///
/// No heap, no double, no globals; different trackers may be used at the same time.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

#include "dotpose/fix.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Sums and gains over (x, y, theta, their velocities), in mm, rad and seconds.
using Covariance6 = std::array<std::array<float, 6>, 6>;

/// Where one frame saw the robot.
struct Sighting {
    std::int64_t time_us = 0;  ///< of the middle of the exposure, on any clock
    std::int64_t x_nm = 0;
    std::int64_t y_nm = 0;
    std::int32_t theta_bam = 0;
    /// Sightings of different planes have nothing to do with each other.
    std::uint32_t plane = 0;
    std::array<std::array<float, 3>, 3> covariance{};  ///< of x, y, theta, in mm and rad
    /// As in Fix. Above TrackOptions::max_p_wrong_log2 the sighting is *weak*.
    int p_wrong_log2 = 0;
    std::int32_t spacing_nm = 508'000;  ///< of the pattern that was seen
    /// The plane's y axis points up the paper: angles turn the other way than the pattern's.
    bool is_y_up = false;
};

/// A fix in the pattern frame, the plane being its section. The fix must be ok and its spacing
/// known, at most 20 mm.
Sighting sighting_of(const Fix& fix, std::int64_t time_us);

struct TrackOptions {
    /// Deviation of the robot's acceleration while it manoeuvres; while it does not, the filter
    /// finds that out. Larger follows sudden changes faster. Default: a table-top robot.
    float acceleration_mm_s2 = 600;
    float angular_acceleration_rad_s2 = 6;

    /// What physics allows. A sighting further from the prediction than the largest acceleration
    /// explains is not believed before it was confirmed.
    float max_acceleration_mm_s2 = 10'000;
    float max_angular_acceleration_rad_s2 = 200;
    /// Decide how far the robot may have come while it was not seen.
    float max_speed_mm_s = 1000;
    float max_turn_rad_s = 20;
    /// Deviations of the prediction that are allowed besides.
    float gate_sigmas = 5;
    /// Consecutive sightings that must agree with each other before a jump is believed. More are
    /// slower; fewer let a single wrong fix through.
    int confirmations = 3;

    /// Without a believed sighting for this long, the robot is lost.
    std::int64_t lost_after_us = 70'000;

    /// A robot that stays within these for `stationary_after_us` is stationary.
    float still_mm = 0.1F;
    float still_rad = 0.02F;
    std::int64_t stationary_after_us = 500'000;

    /// Added to what a sighting claims: printing errors, which the same place shows in every frame.
    float least_sigma_mm = 0.0002F;
    float least_sigma_rad = 0.00002F;

    /// A sighting, together with the prior, may be wrong with 2^this.
    int max_p_wrong_log2 = -30;
    /// Weak sightings above this are never believed, whatever the prior. At most -1.
    int max_weak_p_wrong_log2 = -10;
    /// Of the pattern, to count the places that the prior leaves.
    float spacing_mm = 0.508F;
};

/// Where the robot is and how it moves.
struct TrackedPose {
    std::int64_t time_us = 0;
    std::int64_t x_nm = 0;
    std::int64_t y_nm = 0;
    std::int32_t theta_bam = 0;
    std::uint32_t plane = 0;
    float vx_mm_s = 0;
    float vy_mm_s = 0;
    float turn_rad_s = 0;
    Covariance6 covariance{};

    // Double precision only here, outside the embedded object code.
    double x_mm() const { return static_cast<double>(x_nm) * 1e-6; }
    double y_mm() const { return static_cast<double>(y_nm) * 1e-6; }
    /// In [-pi, pi).
    double theta_rad() const { return theta_bam * (std::numbers::pi / 2147483648.0); }
};

/// What was made of a frame's sighting.
enum class Verdict : std::uint8_t {
    none,        ///< there was none
    believed,    ///< alone sure enough, and possible
    with_prior,  ///< weak, but sure enough together with the prior
    gated,       ///< contradicts physics, and not confirmed yet
    too_weak,    ///< weak, and the prior does not help
};
inline constexpr int kVerdictCount = 5;
/// The identifier, such as "with_prior".
const char* name(Verdict verdict) noexcept;

/// Changes that a frame brought. Several may come together.
struct TrackEvents {
    bool fix = false;         ///< was lost, and is found
    bool lost = false;        ///< not seen for too long
    bool kidnapped = false;   ///< is where it cannot have driven to; confirmed
    bool stationary = false;  ///< came to rest
    bool moving = false;      ///< was stationary, and moves again
};

struct Track {
    bool is_lost = true;
    bool is_stationary = false;
    Verdict verdict = Verdict::none;
    /// With the prior taken into account; 0 without a believed sighting.
    int p_wrong_log2 = 0;
    TrackEvents events;
    /// At the time of the newest frame; between sightings predicted. Means nothing while lost.
    TrackedPose pose;
};

/// Of the filter; for Tracker alone.
namespace track {

using Vector3 = std::array<float, 3>;
using Matrix3 = std::array<Vector3, 3>;
using Vector9 = std::array<float, 9>;
using Covariance9 = std::array<Vector9, 9>;

struct MotionEstimate {
    TrackedPose pose;
    Vector3 acceleration{};    ///< mm/s^2, rad/s^2
    Covariance9 covariance{};  ///< of (x, y, theta), their velocities and accelerations
    /// Variance of the acceleration along each axis, in parts of that in TrackOptions.
    Vector3 agility{1, 1, 1};
    Vector3 innovation{};  ///< of the newest sighting
    Matrix3 noise{};       ///< the same: its covariance
    /// Mean square of the innovations, in units of what their covariances say.
    float scatter = 1;
};

}  // namespace track

class Tracker {
  public:
    /// Starts lost.
    explicit Tracker(const TrackOptions& options = {}) : options_(options) {}

    /// Takes the next frame: its time, and what it saw, if anything (null: no fix). Frames that are
    /// not newer than the last one are ignored.
    const Track& update(std::int64_t time_us, const Sighting* sighting);

    const Track& track() const { return track_; }

    /// Where the frame at `time_us` will show the pattern: as the newest ok fix, of which `seen` is
    /// the sighting, but with the pose that the filter expects then, and its uncertainty. A
    /// sighting that is not believed yet counts with those that agree with it. While the filter
    /// expects nothing (it has not followed `seen`, or will be lost by then) as the fix has it.
    /// `options` are those of `locate`.
    Prediction predict(std::int64_t time_us, const Fix& newest, const Sighting& seen,
                       const Options& options) const;

    /// Whether a weak sighting of the next frame could be believed: worth locating with a relaxed
    /// IntegrityOptions::max_p_wrong_log2.
    bool has_prior() const { return !track_.is_lost; }

  private:
    /// The motion of which `seen` is the newest sighting; null if there is none.
    const track::MotionEstimate* following(const Sighting& seen) const;
    Verdict judge(const track::MotionEstimate& prediction, const Sighting& sighting);
    bool is_confirmed(const Sighting& sighting);
    void restart(const track::MotionEstimate& motion);
    void watch_motion();

    TrackOptions options_;
    Track track_;
    bool was_seen_ = false;
    bool has_frame_ = false;
    std::int64_t newest_us_ = 0;
    track::MotionEstimate last_;  ///< at the last believed sighting
    /// At the newest sighting that contradicts, followed like the believed ones: where the robot is
    /// if it was put somewhere else.
    track::MotionEstimate candidate_;
    int agreeing_ = 0;  ///< sightings that the candidate was made of
    TrackedPose rest_;  ///< from where movement is counted
};

}  // namespace dotpose

#pragma GCC visibility pop
