// Measures what fraction of degraded frames is located. Prints the table for docs/limits.md in
// Markdown.
//
//   dotpose_tables limits [--frames N] [--seed S] [--threads N]
//
// Attempts to locate N frames for each condition in tests/limit_frames.hpp. Conditions with large
// images or mirror images use fewer frames, because these images take longer. The exit status is 1
// if any fix is wrong.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "../tests/limit_frames.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

/// Minimum number of frames per condition, unless --frames is smaller.
constexpr std::uint64_t kMinFrames = 4;

/// Returns the number of images that together have as many pixels as `frames` images of 320 x 240
/// px, clamped to [kMinFrames, `frames`].
int frames_of(const CameraModel& camera, std::uint64_t frames) {
    constexpr std::uint64_t kFull_px = 320 * 240;
    const std::uint64_t area_px =
        static_cast<std::uint64_t>(camera.width_px) * static_cast<std::uint64_t>(camera.height_px);
    const std::uint64_t affordable = std::max(frames * kFull_px / area_px, kMinFrames);
    return static_cast<int>(std::min(affordable, frames));
}

std::string micrometres(double value) {
    return std::isnan(value) ? "-" : fmt::format("{:.1f}", value);
}

/// Locates all frames twice: with the first attempt only, and with both attempts. Throws Error if
/// interrupted.
std::array<Score, 2> score_once_and_twice(const std::string& what, FrameRun frames,
                                          const DeviceOptions& options, const TableRun& run) {
    frames.options.assign(2, options);
    frames.options[0].effort = Effort::once;
    frames.options[1].effort = Effort::twice;
    const auto outcomes = run.evaluate(what, std::move(frames));
    return {score_of(outcomes[0]), score_of(outcomes[1])};
}

/// Prints the table row for one condition and returns its number of wrong fixes.
int print_limit(const test::Limit& limit, std::uint64_t frames, const TableRun& run) {
    FrameRun frame_run;
    frame_run.frames = frames_of(limit.camera, frames);
    frame_run.frame_at = [&](int index) {
        const Shot shot = shot_at(limit, run.seed, static_cast<std::uint64_t>(index));
        return KnownFrame{picture_of(limit, shot), truth_of(shot), {}, {}};
    };
    const auto [once, twice] =
        score_once_and_twice(limit.condition, frame_run, options_of(limit), run);
    fmt::print("| {} | {} | {:.1f} | {:.1f} | {} | {} | {} |\n", limit.condition, frame_run.frames,
               100 * once.located_fraction(), 100 * twice.located_fraction(), twice.wrong,
               micrometres(twice.position_um.median), micrometres(twice.position_um.p95));
    std::fflush(stdout);
    return twice.wrong;
}

/// Prints the number of mirror images that are refused with the status `mirrored`. Returns the
/// number of wrong fixes: a mirror image has no correct fix, so every fix is wrong.
int print_mirrored(std::uint64_t frames, const TableRun& run) {
    FrameRun frame_run;
    frame_run.frames = static_cast<int>(std::min(std::max(frames / 10, kMinFrames), frames));
    frame_run.frame_at = [&](int index) {
        Setup setup;
        setup.seed = run.seed;
        const Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
        KnownFrame frame{render_scene(Scene::mirrored, shot), truth_of(shot), {}, {}};
        frame.truth.has_pose = false;
        return frame;
    };
    const Score score = score_once_and_twice("mirror images", frame_run, {}, run).back();
    const int refused = score.by_status[static_cast<std::size_t>(Status::mirrored)];
    fmt::print(
        "\nOf {} nominal frames seen from behind, {} are refused as `mirrored`, {} located.\n",
        frame_run.frames, refused, score.wrong);
    return score.wrong;
}

}  // namespace

bool limits_table(TableRun& run) {
    std::uint64_t frames = 200;
    run.add_count("--frames", frames, "Number of frames for each condition");
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;

    fmt::print(
        "| condition | frames | located by the first attempt, % | located, % | wrong | median "
        "error, µm "
        "| 95 %, µm |\n|---|--:|--:|--:|--:|--:|--:|\n");
    int wrong = 0;
    for (const test::Limit& limit : test::all_limits())
        wrong += print_limit(limit, frames, run);
    wrong += print_mirrored(frames, run);
    return wrong == 0;
}

}  // namespace dotpose::tables
