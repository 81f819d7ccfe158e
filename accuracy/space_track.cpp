// Renders frames from a camera that moves and tilts, and measures the errors of tracking the camera
// in space (docs/pose-in-space.md). Prints a table in Markdown. With --update, also writes the
// table to DOCUMENT.
//
//   dotpose_tables space_track [--frames N] [--seed S] [--threads N] [--update DOCUMENT]
#include "dotpose/tools/space_track.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"
#include "space_view.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

constexpr int kStart = 30;  ///< number of initial frames that are not counted

/// Returns the view of a camera at time `t_s`. The camera moves like a writing hand, over a width
/// of 20 mm and with tilts of up to 30 degrees.
Shot hand_shot(const Shot& first, double t_s, std::uint64_t seed) {
    Shot shot = first;
    CameraPose& pose = shot.pose;
    const double mm = shot.page.pattern.spacing_mm;
    const double x = pose.fraction_x + (10 + 10 * std::sin(5.1 * t_s)) / mm;
    const double y = pose.fraction_y + (10 + 8 * std::cos(4.3 * t_s)) / mm;
    pose.cell.x += static_cast<std::uint32_t>(x);
    pose.cell.y += static_cast<std::uint32_t>(y);
    pose.fraction_x = x - std::floor(x);
    pose.fraction_y = y - std::floor(y);
    pose.theta_rad += 0.3 * std::sin(1.3 * t_s);
    pose.tilt_x_rad = 0.25 + 0.2 * std::sin(2.1 * t_s);
    pose.tilt_y_rad = 0.25 * std::cos(1.7 * t_s);
    shot.seed = seed;
    return shot;
}

/// Sums of pose errors. Also contains the sums of velocity errors if `add_velocity` is called for
/// each pose.
struct TrackErrors {
    std::uint64_t count = 0;
    double position = 0;    ///< sum of the squared errors, mm^2
    double rotation = 0;    ///< sum of the squared errors, rad^2
    double normalised = 0;  ///< sum of the normalised squared errors, divided by 6
    double velocity = 0;    ///< sum of the squared velocity errors, mm^2/s^2
    /// Sum of the normalised squared velocity errors, divided by 3.
    double normalised_velocity = 0;

    void add(const CameraInSpace& camera, const SpaceCovariance& covariance,
             const TrueSpacePose& truth) {
        const SpaceVector error = space_error(camera, truth);
        ++count;
        position += error.head<3>().squaredNorm();
        rotation += error.tail<3>().squaredNorm();
        normalised += normalised_square(error, matrix_of(covariance)) / 6;
    }
    /// Adds the error of a velocity.
    void add_velocity(const SpaceTrack& track, const Eigen::Vector3d& truth_mm_s) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double error = track.velocity_mm_s[i] - truth_mm_s[Eigen::Index(i)];
            velocity += error * error;
            normalised_velocity += error * error / track.velocity_covariance[i][i] / 3;
        }
    }
    double mean(double sum) const { return sum / static_cast<double>(count); }
    std::string text() const {
        return fmt::format("{:.4f} | {:.4f} | {:.2f}", std::sqrt(mean(position)),
                           std::sqrt(mean(rotation)) * kDegrees, mean(normalised));
    }
    std::string velocity_text() const {
        return fmt::format("{:.2f} | {:.2f}", std::sqrt(mean(velocity)), mean(normalised_velocity));
    }
};

/// Returns the true velocity of the camera in `hand_shot`.
Eigen::Vector3d true_velocity_mm_s(const Shot& first, double t_s) {
    constexpr double kStep_s = 1e-4;
    const TrueSpacePose before = true_space_pose(hand_shot(first, t_s - kStep_s, 0));
    const TrueSpacePose after = true_space_pose(hand_shot(first, t_s + kStep_s, 0));
    return (after.position_mm - before.position_mm) / (2 * kStep_s);
}

/// Tracks the camera through a sequence of sightings. Returns a table row with the errors.
std::string row_text(double fps, const Shot& first, const std::vector<Shot>& shots,
                     const std::vector<std::optional<SpaceSighting>>& sightings) {
    SpaceTracker tracker;
    TrackErrors single;
    TrackErrors tracked;
    TrackErrors predicted;
    int rejected = 0;
    for (std::size_t i = 0; i < shots.size(); ++i) {
        const auto time_us = static_cast<std::int64_t>(std::llround(1e6 * double(i) / fps));
        const auto ahead = tracker.predict(time_us);
        const SpaceTrack& track =
            sightings[i] ? tracker.update(*sightings[i]) : tracker.update(time_us);
        rejected += track.verdict == SpaceVerdict::rejected ? 1 : 0;
        if (i < kStart || track.is_lost || !ahead || !sightings[i]) continue;
        const TrueSpacePose truth = true_space_pose(shots[i]);
        single.add(sightings[i]->camera, sightings[i]->covariance, truth);
        tracked.add(track.camera, track.covariance, truth);
        tracked.add_velocity(track, true_velocity_mm_s(first, static_cast<double>(i) / fps));
        predicted.add(ahead->camera, ahead->covariance, truth);
    }
    return fmt::format("| {} | {} of {} | {} | {} | {} | {} | {} |\n", fps, single.count,
                       shots.size() - kStart, rejected, single.text(), tracked.text(),
                       tracked.velocity_text(), predicted.text());
}

}  // namespace

bool space_track_table(TableRun& run) {
    std::uint64_t frames = 1030;
    run.add_count("--frames", frames, "Number of frames of each row");
    run.add_seed();
    run.add_threads();
    run.add_update();
    if (!run.parse()) return true;
    std::string text =
        "| frames/s | tracked | rejected | single frames: position, mm rms | rotation, degrees rms "
        "| error² / variance | tracked: position | rotation | error² / variance | velocity, "
        "mm/s rms | error² / variance | predicted by a frame: position | rotation | error² / "
        "variance |\n"
        "|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    bool is_complete = true;
    for (const double fps : {30.0, 60.0, 120.0}) {
        const Shot first = space_shot(kSpaceLenses[1], 0, scramble(run.seed + 3000), 0);
        std::vector<Shot> shots;
        for (std::uint64_t i = 0; i < frames; ++i)
            shots.push_back(hand_shot(first, static_cast<double>(i) / fps, scramble(i + 1)));
        std::vector<std::optional<SpaceSighting>> sightings(frames);
        struct Nothing {
            void operator+=(const Nothing&) {}
        };
        const auto count = run.count<Nothing>(
            fmt::format("{} frames/s", fps), frames, [&](std::uint64_t i, Nothing&) {
                const SpaceReading reading(shots[i]);
                const auto time_us = std::llround(1e6 * static_cast<double>(i) / fps);
                if (reading.pose()) sightings[i] = sighting_of(*reading.pose(), time_us);
            });
        is_complete &= count.is_complete();
        text += row_text(fps, first, shots, sightings);
    }
    run.print_block("space track", text);
    run.update_document();
    return is_complete;
}

}  // namespace dotpose::tables
