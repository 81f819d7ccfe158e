/// The subcommands that need a camera or a network. They are in a separate program, which `dotpose`
/// starts, because the libraries for video take a tenth of a second to load.
#pragma once

#include "command_line.hpp"

namespace dotpose::cli {

void add_watch(Command& app, int& exit_code);
void add_fleet(Command& app, int& exit_code);

/// Registers all of these.
void add_live_commands(Command& app, int& exit_code);

}  // namespace dotpose::cli
