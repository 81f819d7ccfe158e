/// The subcommands that need a camera or a network. They are a program of their own, which
/// `dotpose` starts: the libraries for video take five times as long to load as all other commands
/// run.
#pragma once

#include <CLI/CLI.hpp>

namespace dotpose::cli {

void add_watch(CLI::App& app, int& exit_code);
void add_fleet(CLI::App& app, int& exit_code);

}  // namespace dotpose::cli
