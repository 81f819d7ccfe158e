/// Says what is wrong with a command line, and what was probably meant.
#pragma once

#include <string>

#include "command_line.hpp"

namespace dotpose::cli {

/// The command that prints the help of another one.
inline constexpr const char* kHelpCommand = "help";

/// Returns the message for an error that `app` threw while it parsed. Unknown words are reported
/// first: a misspelt `--out` would otherwise be "--out is required".
std::string usage_error(const Command& app, const UsageError& error);

/// Throws UsageError if an option that has a short form is written with one hyphen, as in
/// `-out sheet.pdf`: it would be taken for `-o` with the file name "ut". The words are those of
/// `main`.
void require_two_hyphens(const Command& command, int argc, const char* const* argv);

/// Returns "dotpose COMMAND --help" for the command that was parsed, else "dotpose --help".
std::string help_command(const Command& app);

}  // namespace dotpose::cli
