/// The subcommands that need a camera or a network. They are in a separate program, which `dotpose`
/// starts, because the libraries for video take a tenth of a second to load.
#pragma once

#include <CLI/CLI.hpp>

namespace dotpose::cli {

void add_watch(CLI::App& app, int& exit_code);
void add_fleet(CLI::App& app, int& exit_code);

/// Registers all of these.
void add_live_commands(CLI::App& app, int& exit_code);

}  // namespace dotpose::cli
