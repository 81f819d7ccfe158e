/// Completes command lines for the shell scripts in apps/shell.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// First argument of a completion request. The words of the command line follow it.
inline constexpr const char* kComplete = "__complete";

/// Prints the completions of the last word: commands, options, or values of an option. Each line
/// contains a completion, a tab and a description. Prints nothing if the word may be a file name or
/// arbitrary text. The options of commands that dotpose-live implements are not known to `dotpose`.
/// For such a command, runs its callback, which starts dotpose-live to print the completions.
void print_completions(Command& app, std::vector<std::string> words);

}  // namespace dotpose::cli
