/// The subcommands that need a camera or a network, in a separate program, which `dotpose` starts.
#pragma once

#include "command_line.hpp"

namespace dotpose::cli {

void add_watch(Command& app, int& exit_code);
void add_fleet(Command& app, int& exit_code);

/// Registers all of these.
void add_live_commands(Command& app, int& exit_code);

}  // namespace dotpose::cli
