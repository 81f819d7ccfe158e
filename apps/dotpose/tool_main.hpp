/// What `main` of both programs does around its subcommands.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace dotpose::cli {

/// Parses the command line with the subcommands that `add` registers, runs the one that was named,
/// and turns what goes wrong into a message and an exit status.
int tool_main(int argc, char** argv,
              const std::function<void(CLI::App& app, int& exit_code)>& add) noexcept;

}  // namespace dotpose::cli
