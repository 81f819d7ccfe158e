/// The subcommands of the tool, one file each. A command registers itself with its options; when
/// the user chose it, CLI11 runs its callback, which sets `exit_code` if that is not to be 0.
/// Callbacks throw dotpose::Error; main.cpp turns it into a message and an exit status.
#pragma once

#include <CLI/CLI.hpp>

namespace dotpose::cli {

inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;

void add_print(CLI::App& app, int& exit_code);
void add_overlay(CLI::App& app, int& exit_code);
void add_locate(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_evaluate(CLI::App& app, int& exit_code);
void add_check_print(CLI::App& app, int& exit_code);
void add_calibrate(CLI::App& app, int& exit_code);
void add_optics(CLI::App& app, int& exit_code);

}  // namespace dotpose::cli
