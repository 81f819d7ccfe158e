// Counts the results of `locate` with correct and with wrong predictions.
//
//   dotpose_tables tracked [--part NAME] [--frames N] [--predictions N] [--seed S]
//                          [--update docs/tracking.md]
//
// Prints four tables: tracked drives, predictions with errors, changes between two frames, and
// classes of wrong predictions. The exit status is 1 if any fix is wrong. Ctrl-C ends the run early
// and prints the results so far.
#include "tracked.hpp"

#include <string>
#include <vector>

#include <fmt/core.h>

#include "../apps/dotpose/choices.hpp"
#include "tables.hpp"

namespace dotpose::tables {

bool tracked_table(TableRun& run) {
    std::vector<std::string> parts = {"drives", "offsets", "changes", "wrong"};
    std::uint64_t frames = 1000;
    std::uint64_t predictions = 1'000'000;
    run.command
        .add_option("--part", parts,
                    "Only this table, given once or more: " + cli::alternatives(parts))
        ->check(cli::one_of(parts));
    run.add_count("--frames", frames, "Frames of the parts offsets and changes");
    run.add_count("--predictions", predictions,
                  "Wrong predictions, divided evenly among their classes");
    run.add_update();
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;

    const auto table_of = [&](const std::string& part) {
        if (part == "drives") return drives_table(run);
        if (part == "offsets") return offsets_table(run, frames);
        if (part == "changes") return changes_table(run, frames);
        return wrong_predictions_table(run, predictions);
    };
    std::uint64_t wrong = 0;
    bool is_complete = true;
    for (const std::string& part : parts) {
        const TrackedTable table = table_of(part);
        run.print_block("tracked-" + part, table.text);
        wrong += table.wrong;
        is_complete = is_complete && table.is_complete;
    }
    fmt::print("seed {}: {} wrong\n", run.seed, wrong);
    run.update_document();
    return is_complete && wrong == 0;
}

}  // namespace dotpose::tables
