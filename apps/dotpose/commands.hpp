/// Subcommands of the tool, each in its own source file. Each function registers a command, its
/// options and a callback. CLI11 runs the callback if the command is given. On failure, the
/// callback sets `exit_code` or throws dotpose::Error, which main.cpp converts into a message and
/// an exit status.
#pragma once

#include "command_line.hpp"
#include "exit_codes.hpp"

namespace dotpose::cli {

void add_print(Command& app, int& exit_code);
void add_overlay(Command& app, int& exit_code);
void add_locate(Command& app, int& exit_code);
void add_simulate(Command& app, int& exit_code);
void add_evaluate(Command& app, int& exit_code);
void add_check_print(Command& app, int& exit_code);
void add_calibrate(Command& app, int& exit_code);
void add_optics(Command& app, int& exit_code);
void add_listen(Command& app, int& exit_code);
void add_replay(Command& app, int& exit_code);
void add_ink(Command& app, int& exit_code);
void add_sheets(Command& app, int& exit_code);

/// Registers all subcommands.
void add_commands(Command& app, int& exit_code);

/// Registers the commands that dotpose-live executes, but not their options.
void add_live(Command& app);

}  // namespace dotpose::cli
