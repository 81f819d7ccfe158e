// Measures whether the covariance of a fix is right where the sheet is not one plane: halves of a
// sheet that are displaced against each other, and wrinkled paper. Prints the table of
// docs/integrity.md in Markdown.
//
//   dotpose_slips [--frames N] [--seed S] [--threads N]
//
// There are N frames for each condition. The exit status is 1 if any fix is wrong.
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "../tests/slipped_frames.hpp"
#include "uneven_table.hpp"

namespace {

using namespace dotpose;

struct Arguments {
    Counting counting;
    std::uint64_t frames = 1000;
};

struct Condition {
    std::string what;
    std::function<void(Shot&)> spoil;
    Preset preset = Preset::nominal;
    bool is_large = false;  ///< 640 x 480 instead of 188 x 120
    Effort effort = Effort::twice;
};

KnownFrame frame_of(const Condition& condition, std::uint64_t seed, int index) {
    Setup setup;
    setup.preset = condition.preset;
    setup.seed = seed;
    if (condition.is_large) {
        setup.camera.width_px = 640;
        setup.camera.height_px = 480;
    }
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    condition.spoil(shot);
    return {render(shot), truth_of(shot), {}, {}};
}

SheetFrames frames_of(const Condition& condition, std::uint64_t seed) {
    return {condition.what, condition.is_large ? "640 x 480" : "188 x 120",
            [=](int index) { return frame_of(condition, seed, index); }, condition.effort};
}

std::vector<Condition> all_conditions() {
    const auto slip = [](Shot& shot) { test::apply(test::draw_slip(shot), shot); };
    std::vector<Condition> conditions;
    for (const bool is_large : {false, true}) {
        conditions.push_back({"whole", [](Shot&) {}, Preset::nominal, is_large});
        conditions.push_back({"slipped", slip, Preset::nominal, is_large});
        conditions.push_back(
            {"slipped, first attempt alone", slip, Preset::nominal, is_large, Effort::once});
        conditions.push_back({"slipped, hard", slip, Preset::hard, is_large});
        for (const double amplitude : {0.02, 0.05, 0.10}) {
            conditions.push_back({fmt::format("wrinkled by {:.2f}", amplitude),
                                  [=](Shot& shot) { test::wrinkle(amplitude, shot); },
                                  Preset::nominal, is_large});
        }
    }
    return conditions;
}

int run(const Arguments& arguments) {
    print_uneven_head();
    int wrong = 0;
    for (const Condition& condition : all_conditions())
        wrong += print_uneven_row(frames_of(condition, arguments.counting.seed),
                                  static_cast<int>(arguments.frames), arguments.counting);
    return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    cli::Command app(
        "Does a fix tell how exact it is where the sheet is not one plane? Status 1 if any is "
        "wrong.",
        "dotpose_slips");
    add_count(app, "--frames", arguments.frames, "How many of each condition");
    arguments.counting.add_to(app);
    return run_program(app, argc, argv, [&] { return run(arguments); });
}
