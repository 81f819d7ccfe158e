/// Error messages for invalid command lines, with suggestions.
#pragma once

#include <string>

#include "command_line.hpp"

namespace dotpose::cli {

/// Name of the command that prints the help for other commands.
inline constexpr const char* kHelpCommand = "help";

/// Returns the message for an error that `app` threw during parsing. Reports unknown words first.
/// Otherwise, a misspelt `--out` would be reported as "--out is required".
std::string usage_error(const Command& app, const UsageError& error);

/// Throws UsageError if the long name of an option that also has a short name is written with a
/// single hyphen. For example, `-out sheet.pdf` would be parsed as the option `-o` with the file
/// name "ut". `argc` and `argv` are the arguments of `main`.
void require_two_hyphens(const Command& command, int argc, const char* const* argv);

/// Returns "dotpose COMMAND --help" for the parsed command, or "dotpose --help" if no command was
/// parsed.
std::string help_command(const Command& app);

}  // namespace dotpose::cli
