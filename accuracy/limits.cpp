// Measures how much frames may be degraded. Prints the table of docs/limits.md in Markdown.
//
//   dotpose_limits [--frames N] [--seed S] [--threads N]
//
// There are N frames for each condition of tests/limit_frames.hpp, but fewer for large images and
// mirror images, which take long. The exit status is 1 if any fix is wrong.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "../tests/limit_frames.hpp"
#include "dotpose/tools/score.hpp"
#include "evaluate_all.hpp"

namespace {

using namespace dotpose;

struct Arguments {
    Counting counting;
    std::uint64_t frames = 200;
};

/// Fewest frames of a condition, unless fewer were asked for.
constexpr std::uint64_t kFewest = 4;

/// Returns the number of frames that have as many pixels in all as `frames` images of 320 x 240.
int frames_of(const CameraModel& camera, std::uint64_t frames) {
    constexpr std::uint64_t kFull_px = 320 * 240;
    const std::uint64_t area_px =
        static_cast<std::uint64_t>(camera.width_px) * static_cast<std::uint64_t>(camera.height_px);
    const std::uint64_t affordable = std::max(frames * kFull_px / area_px, kFewest);
    return static_cast<int>(std::min(affordable, frames));
}

std::string micrometres(double value) {
    return std::isnan(value) ? "-" : fmt::format("{:.1f}", value);
}

using Outcomes = std::vector<std::vector<Outcome>>;

/// Locates all frames with the first attempt only, and with both attempts. Throws Error if
/// interrupted.
Outcomes locate_all(const std::string& what, FrameRun run, const Arguments& arguments,
                    const Options& options) {
    run.options.assign(2, options);
    run.options[0].effort = Effort::once;
    run.options[1].effort = Effort::twice;
    return evaluate_all(what, std::move(run), arguments.counting);
}

/// Prints the row of one condition and returns the number of wrong fixes.
int print_limit(const test::Limit& limit, const Arguments& arguments) {
    FrameRun run;
    run.frames = frames_of(limit.camera, arguments.frames);
    run.frame_at = [&](int index) {
        const Shot shot =
            shot_at(limit, arguments.counting.seed, static_cast<std::uint64_t>(index));
        return KnownFrame{picture_of(limit, shot), truth_of(shot), {}, {}};
    };
    const Outcomes outcomes = locate_all(limit.condition, run, arguments, options_of(limit));
    const Score once = score_of(outcomes.front());
    const Score twice = score_of(outcomes.back());
    fmt::print("| {} | {} | {:.1f} | {:.1f} | {} | {} | {} |\n", limit.condition, run.frames,
               100 * once.located_share(), 100 * twice.located_share(), twice.wrong,
               micrometres(twice.position_um.median), micrometres(twice.position_um.p95));
    std::fflush(stdout);
    return twice.wrong;
}

/// Prints how often mirror images are refused with the status `mirrored`, and returns the number of
/// fixes, all of which are wrong.
int print_mirrored(const Arguments& arguments) {
    FrameRun run;
    run.frames =
        static_cast<int>(std::min(std::max(arguments.frames / 10, kFewest), arguments.frames));
    run.frame_at = [&](int index) {
        Setup setup;
        setup.seed = arguments.counting.seed;
        const Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
        KnownFrame frame{render_scene(Scene::mirrored, shot), truth_of(shot), {}, {}};
        frame.truth.has_pose = false;
        return frame;
    };
    const Score score = score_of(locate_all("mirror images", run, arguments, {}).back());
    const int refused = score.by_status[static_cast<std::size_t>(Status::mirrored)];
    fmt::print(
        "\nOf {} nominal frames seen from behind, {} are refused as `mirrored`, {} located.\n",
        run.frames, refused, score.wrong);
    return score.wrong;
}

int run(const Arguments& arguments) {
    fmt::print(
        "| condition | frames | located at once, % | located, % | wrong | median error, µm "
        "| 95 %, µm |\n|---|--:|--:|--:|--:|--:|--:|\n");
    int wrong = 0;
    for (const test::Limit& limit : test::all_limits())
        wrong += print_limit(limit, arguments);
    wrong += print_mirrored(arguments);
    return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    cli::Command app("How bad may a frame be? Status 1 if any fix is wrong.", "dotpose_limits");
    add_count(app, "--frames", arguments.frames, "How many for each condition");
    arguments.counting.add_to(app);
    return run_program(app, argc, argv, [&] { return run(arguments); });
}
