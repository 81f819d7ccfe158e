/// The common part of the `main` functions of dotpose and dotpose-live.
#pragma once

#include <functional>

#include "command_line.hpp"
#include "dotpose/version.hpp"

namespace dotpose::cli {

using AddCommands = std::function<void(Command& app, int& exit_code)>;

/// Runs the subcommand given on the command line. `add` registers all subcommands. Converts
/// exceptions to a message and an exit status.
int tool_main(int argc, char** argv, const AddCommands& add) noexcept;

}  // namespace dotpose::cli
