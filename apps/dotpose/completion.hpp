/// Completions of command lines, which the shells ask for (apps/shell).
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// The word before a command line whose completions are wanted.
inline constexpr const char* kComplete = "__complete";

/// Prints what may stand in the place of the last of `words`: commands, options or values of an
/// option, a line for each with its description after a tab. Prints nothing where any text or file
/// may stand. Runs the callback of a command that another program executes.
void print_completions(Command& app, std::vector<std::string> words);

}  // namespace dotpose::cli
