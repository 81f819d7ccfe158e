// Locates many frames and prints tables of the results, most of them in Markdown.
//
//   dotpose_tables TABLE [OPTION...]
//   dotpose_tables TABLE --help
//
// The exit status is 1 if a fix is wrong or the run was interrupted, and 2 if the command line is
// invalid.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

#include <fmt/core.h>

#include "tables.hpp"

namespace {

using namespace dotpose;

constexpr int kWrongUsage = 2;

struct Table {
    std::string_view name;
    const char* what;
    bool (*measure)(tables::TableRun& run);
};

constexpr Table kTables[] = {
    {"accuracy", "Errors of clean, nominal and hard frames, by condition, and as in the paper",
     tables::accuracy_table},
    {"adversarial", "How often images that resemble the code are located",
     tables::adversarial_table},
    {"alike", "Errors of frames whose dots all have the same sub-pixel phase", tables::alike_table},
    {"bound", "Errors of positions beside the Cramer-Rao bound", tables::bound_table},
    {"calibration", "Errors of calibrations and of their standard deviations",
     tables::calibration_table},
    {"drive", "Errors of a robot that is tracked as by `dotpose watch`", tables::drive_table},
    {"golden", "Checksums of frames and fixes, for scripts/golden-frames", tables::golden_table},
    {"integrity", "Whether p_wrong is an upper bound of the frequency of wrong positions",
     tables::integrity_table},
    {"known", "How small views of known sheets may be", tables::known_table},
    {"together", "How soon a moving camera with small views is located", tables::together_table},
    {"limits", "How much frames may be degraded", tables::limits_table},
    {"misread", "How many views are located if the rate of misread bits is known",
     tables::misread_table},
    {"pens", "Errors of the tip of a pen, and of its ink", tables::pens_table},
    {"print_map", "How much a map of the print improves positions", tables::print_map_table},
    {"print_map_drive", "How much a map of the print improves a drive",
     tables::print_map_drive_table},
    {"print_map_errors", "Errors of print maps beside the covariances that they contain",
     tables::print_map_errors_table},
    {"print_map_scale", "Time and memory for a map of many frames", tables::print_map_scale_table},
    {"print_map_solver", "Time and memory of the solver of print maps for 20,000 frames",
     tables::print_map_solver_table},
    {"readout", "How many frames of a rolling shutter are located and tracked",
     tables::readout_table},
    {"seams", "Whether covariances are right where two sheets are butted", tables::seams_table},
    {"slips", "Whether covariances are right where the sheet is not one plane",
     tables::slips_table},
    {"space", "Errors of the poses of tilted cameras in space", tables::space_table},
    {"space_second", "How often a second pose in space is taken for the first",
     tables::space_second_table},
    {"space_tag", "Errors of poses in space beside those of AprilTags", tables::space_tag_table},
    {"space_track", "Errors of a camera that is tracked in space", tables::space_track_table},
    {"tracked", "Results of right and wrong predictions", tables::tracked_table},
    {"views", "Results of views of sheets that others made", tables::views_table},
};

void print_usage(std::FILE* file) {
    fmt::print(file, "usage: dotpose_tables TABLE [OPTION...]\n\nTables:\n");
    for (const Table& table : kTables)
        fmt::print(file, "  {:<16} {}\n", table.name, table.what);
    fmt::print(file, "\ndotpose_tables TABLE --help lists the options of a table.\n");
}

}  // namespace

int main(int argc, char** argv) {
    const std::string_view name = argc > 1 ? argv[1] : "";
    const auto* const table = std::ranges::find(kTables, name, &Table::name);
    if (table == std::end(kTables)) {
        const bool is_help = name == "--help" || name == "-h";
        if (argc > 1 && !is_help) fmt::print(stderr, "there is no table '{}'\n\n", name);
        print_usage(is_help ? stdout : stderr);
        return is_help ? EXIT_SUCCESS : kWrongUsage;
    }
    try {
        tables::TableRun run(fmt::format("dotpose_tables {}", name), table->what, argc - 1,
                             argv + 1);
        cli::catch_interrupts();
        return table->measure(run) ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const cli::UsageError& error) {
        fmt::print(stderr, "{}\nRun with --help for more information.\n", error.what());
        return kWrongUsage;
    } catch (const std::exception& error) {
        fmt::print(stderr, "dotpose_tables {}: {}\n", name, error.what());
        return EXIT_FAILURE;
    }
}
