/// The common part of `main` of dotpose and dotpose-live.
#pragma once

#include <functional>

#include "command_line.hpp"
#include "dotpose/version.hpp"

namespace dotpose::cli {

using AddCommands = std::function<void(Command& app, int& exit_code)>;

/// Parses the command line with the subcommands that `add` registers, and runs the named
/// subcommand. Converts exceptions into a message and an exit status.
int tool_main(int argc, char** argv, const AddCommands& add) noexcept;

}  // namespace dotpose::cli
