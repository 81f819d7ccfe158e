/// Completes command lines for shells. The scripts in apps/shell request completions.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// First argument of a request for completions. The words of the command line follow.
inline constexpr const char* kComplete = "__complete";

/// Prints the completions of the last of `words`, which are commands, options or values of an
/// option. Each line contains a completion, a tab and a description. Prints nothing if the word may
/// be a file or arbitrary text. If dotpose-live implements the command, runs the callback of the
/// command, which starts dotpose-live.
void print_completions(Command& app, std::vector<std::string> words);

}  // namespace dotpose::cli
