/// The common part of `main` in both programs.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace dotpose::cli {

/// Parses the command line with the subcommands that `add` registers and runs the one that is
/// named. Turns exceptions into a message and an exit status.
int tool_main(int argc, char** argv,
              const std::function<void(CLI::App& app, int& exit_code)>& add) noexcept;

}  // namespace dotpose::cli
