// Counts what `locate` makes of right and wrong predictions.
//
//   dotpose_tracked [--part NAME] [--frames N] [--predictions N] [--seed S] [--document FILE]
//
// Prints four tables: drives that are tracked, predictions that are off, frames that change, and
// wrong predictions by class. The exit status is 1 if any fix is wrong. Ctrl-C ends the run and
// prints the tables until then.
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "../apps/dotpose/choices.hpp"
#include "../reports/document.hpp"
#include "counting.hpp"
#include "tracked_drives.hpp"
#include "tracked_frames.hpp"
#include "tracked_wrong.hpp"

namespace dotpose {
namespace {

struct Arguments {
    Counting counting;
    std::uint64_t frames = 1000;
    std::uint64_t predictions = 1'000'000;
    std::vector<std::string> parts = {"drives", "offsets", "changes", "wrong"};
    std::string document;
};

TrackedTable table_of(const std::string& part, const Arguments& arguments) {
    if (part == "drives") return drives_table(arguments.counting);
    if (part == "offsets") return offsets_table(arguments.counting, arguments.frames);
    if (part == "changes") return changes_table(arguments.counting, arguments.frames);
    return wrong_predictions_table(arguments.counting, arguments.predictions);
}

int run(const Arguments& arguments) {
    // A document that cannot be read is reported before the measurement, not an hour later.
    if (!arguments.document.empty()) read_document(arguments.document);
    Blocks blocks;
    std::uint64_t wrong = 0;
    bool is_complete = true;
    for (const std::string& part : arguments.parts) {
        const TrackedTable table = table_of(part, arguments);
        fmt::print("{}\n", table.text);
        std::fflush(stdout);
        blocks.push_back({"tracked-" + part, table.text});
        wrong += table.wrong;
        is_complete = is_complete && table.is_complete;
    }
    fmt::print("seed {}: {} wrong\n", arguments.counting.seed, wrong);
    if (!is_complete) return EXIT_FAILURE;
    if (!arguments.document.empty()) update_document(arguments.document, blocks);
    return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace dotpose

int main(int argc, char** argv) {
    using namespace dotpose;
    Arguments arguments;
    cli::Command app("What becomes of predictions? Status 1 if any fix is wrong.",
                     "dotpose_tracked");
    app.add_option("--part", arguments.parts,
                   "Only this table, given once or more: " + cli::alternatives(arguments.parts))
        ->check(cli::one_of(arguments.parts));
    add_count(app, "--frames", arguments.frames, "Frames that are off, and that change");
    add_count(app, "--predictions", arguments.predictions,
              "Wrong predictions, evenly over their classes");
    app.add_option("--document", arguments.document, "Document whose tables are to be replaced");
    arguments.counting.add_to(app);
    return run_program(app, argc, argv, [&] { return run(arguments); });
}
