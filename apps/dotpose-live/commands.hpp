/// Subcommands that require a camera or a network. dotpose-live implements these subcommands, and
/// `dotpose` starts dotpose-live to run them.
#pragma once

#include "command_line.hpp"

namespace dotpose::cli {

void add_watch(Command& app, int& exit_code);
void add_fleet(Command& app, int& exit_code);

/// Add the subcommands of `fleet`.
void add_fleet_remove(Command& fleet);
void add_fleet_history(Command& fleet);

/// Registers the subcommands.
void add_live_commands(Command& app, int& exit_code);

}  // namespace dotpose::cli
