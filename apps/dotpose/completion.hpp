/// Completions of command lines, which the shells ask for (apps/shell).
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// First argument of a request for completions. The words of the command line follow it.
inline constexpr const char* kComplete = "__complete";

/// Prints the completions of the last of `words`: commands, options or values of an option. Each
/// line has one completion, a tab and its description. Prints nothing if the word can be any text
/// or file. For a command of another program, runs the callback of that command.
void print_completions(Command& app, std::vector<std::string> words);

}  // namespace dotpose::cli
