// Measures whether the covariance of a fix is right where two sheets are butted, on frames that are
// rendered independently of the simulator. Prints rows of a table of docs/integrity.md in Markdown.
//
//   dotpose_seams [--frames N] [--seed S] [--threads N]
//
// There are N frames for each condition. The exit status is 1 if any fix is wrong.
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

#include "../tests/seam_frames.hpp"
#include "uneven_table.hpp"

namespace {

using namespace dotpose;

struct Condition {
    std::string what;
    double max_distance_px;  ///< from the image centre to the seam
};

int run(const Counting& counting, int frames) {
    print_uneven_head();
    int wrong = 0;
    for (const auto& [width_px, height_px] : {std::pair{188, 120}, std::pair{640, 480}}) {
        for (const Condition& condition :
             {Condition{"seam anywhere", std::numeric_limits<double>::infinity()},
              Condition{"seam within 2 spacings of the reference point", 22},
              Condition{"seam through the reference point", 0}}) {
            const auto frame_at = [&, width = width_px, height = height_px](int index) {
                const test::SeamShot shot =
                    test::draw_seam_shot(width, height, condition.max_distance_px, counting.seed,
                                         static_cast<std::uint64_t>(index));
                return KnownFrame{test::render(shot), shot.truth(), {}, {}};
            };
            wrong += print_uneven_row(
                {condition.what, std::to_string(width_px) + " x " + std::to_string(height_px),
                 frame_at},
                frames, counting);
        }
    }
    return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    Counting counting;
    std::uint64_t frames = 1000;
    cli::Command app(
        "Does a fix say how exact it is where two sheets are butted? Status 1 if any is wrong.",
        "dotpose_seams");
    add_count(app, "--frames", frames, "How many of each condition");
    counting.add_to(app);
    return run_program(app, argc, argv, [&] { return run(counting, static_cast<int>(frames)); });
}
