/// Messages and colour on the terminal. Messages may contain untrusted text from files, file names
/// or networks, so unprintable characters are replaced.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "base/printable.hpp"

namespace dotpose::cli {

using base::printable;
using base::with_escaped_controls;

/// Flushes standard output, then writes to standard error. Unlike fmt::print, does not throw if the
/// stream is closed.
void write_to_stderr(const std::string& text);

/// Writes "dotpose: MESSAGE" to standard error as one printable line.
void tell(std::string_view message);

/// Writes the reason for which the program ends. Like `tell`, but in red if colour is enabled.
void tell_failure(std::string_view message);

/// Returns true if the stream is a terminal with colours, unless NO_COLOR (no-color.org) is set or
/// TERM is "dumb".
bool wants_colour(std::FILE* stream);

/// Colours the beginning of each line of a report that states a fault, a note or a good result.
std::string in_colour(const std::string& report);

/// Returns the report, in colour if standard output supports it.
std::string for_standard_output(const std::string& report);

}  // namespace dotpose::cli
