/// The subcommands of the tool, one file each. A command registers itself with its options; when
/// the user chose it, CLI11 runs its callback, which sets `exit_code` if that is not to be 0.
/// Callbacks throw dotpose::Error; main.cpp turns it into a message and an exit status.
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

/// The commands that another program does: see apps/dotpose-live.
void add_live(CLI::App& app);

}  // namespace dotpose::cli
