/// Writers of manual pages and of completions for shells.
#pragma once

#include <string>

#include "declarations.hpp"

namespace dotpose::manuals {

/// Returns the manual page of the tool, dotpose(1).
std::string tool_page(const ToolText& tool);

/// Returns the manual page of a command, such as dotpose-locate(1).
std::string command_page(const ToolText& tool, const CommandText& command);

/// Return the completions for a shell. They offer commands, options, and as values the choices of
/// an option, files or folders.
std::string bash_completions(const ToolText& tool);
std::string zsh_completions(const ToolText& tool);
std::string fish_completions(const ToolText& tool);

}  // namespace dotpose::manuals
