/// The subcommands of the tool, each of which has a file of its own. A command registers itself
/// with its options. If the user names it, CLI11 runs its callback, which sets `exit_code` unless
/// it is 0. Callbacks may throw dotpose::Error, which main.cpp turns into a message and an exit
/// status.
#pragma once

#include <CLI/CLI.hpp>

#include "exit_codes.hpp"

namespace dotpose::cli {

void add_print(CLI::App& app, int& exit_code);
void add_overlay(CLI::App& app, int& exit_code);
void add_locate(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_evaluate(CLI::App& app, int& exit_code);
void add_check_print(CLI::App& app, int& exit_code);
void add_calibrate(CLI::App& app, int& exit_code);
void add_optics(CLI::App& app, int& exit_code);
void add_listen(CLI::App& app, int& exit_code);
void add_replay(CLI::App& app, int& exit_code);
void add_sheets(CLI::App& app, int& exit_code);

/// Registers all of these.
void add_commands(CLI::App& app, int& exit_code);

/// Registers the commands that the program in apps/dotpose-live executes, without their options.
void add_live(CLI::App& app);

}  // namespace dotpose::cli
