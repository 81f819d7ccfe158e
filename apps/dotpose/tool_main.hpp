/// The common part of `main` in both programs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "dotpose/version.hpp"

namespace dotpose::cli {

inline constexpr const char* kVersion = "dotpose " DOTPOSE_VERSION;

/// The commands that the help suggests to a new user.
inline constexpr const char* kFirstDay =
    "  dotpose print -o sheet.pdf   a sheet of dots; print it at 100 %\n"
    "  dotpose locate photo.jpg     where on it a picture was taken\n"
    "  dotpose watch 0              where on it a camera is, live\n";

using AddCommands = std::function<void(Command& app, int& exit_code)>;

/// The command line of a program: the commands that `add` registers, and `help` and `version`.
struct CommandLine {
    explicit CommandLine(const AddCommands& add);

    Command app;
    int exit_code = 0;
    /// After parsing: the words that ask for the help wanted, the last one first; else none.
    std::vector<std::string> help_words;
};

/// Parses the command line with the subcommands that `add` registers and runs the one that is
/// named. Turns exceptions into a message and an exit status.
int tool_main(int argc, char** argv, const AddCommands& add) noexcept;

}  // namespace dotpose::cli
