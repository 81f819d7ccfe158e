/// Completes command lines for shells. The scripts in apps/shell request completions.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// First argument of a request for completions, followed by the words of the command line.
inline constexpr const char* kComplete = "__complete";

/// Prints the completions of the last of `words`: commands, options or values of an option. Each
/// line contains a completion, a tab and a description. Prints nothing if the word may be arbitrary
/// text or a file. If the command belongs to dotpose-live, runs the callback of the command. The
/// callback starts dotpose-live.
void print_completions(Command& app, std::vector<std::string> words);

}  // namespace dotpose::cli
