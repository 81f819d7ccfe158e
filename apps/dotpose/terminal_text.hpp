/// Messages and colours on the terminal. Unprintable characters in messages are replaced, because
/// messages may contain untrusted text from files, file names or networks.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "base/printable.hpp"

namespace dotpose::cli {

using base::printable;
using base::with_escaped_controls;

/// Flushes standard output, then writes to standard error. Unlike fmt::print, does not throw if a
/// stream is closed.
void write_to_stderr(const std::string& text);

/// Writes "dotpose: MESSAGE" to standard error as one printable line.
void notify(std::string_view message);

/// Writes the reason why the program ends, in the format of `notify`, but in red if colours are
/// enabled.
void notify_failure(std::string_view message);

/// Returns true if the stream is a terminal that supports colours, and colours are not disabled by
/// NO_COLOR (no-color.org) or TERM=dumb.
bool wants_colour(std::FILE* stream);

/// Colours the prefix of each report line that states a fault, a note, a warning or a verdict.
std::string in_colour(const std::string& report);

/// Returns the report, with colours if standard output supports them.
std::string for_standard_output(const std::string& report);

}  // namespace dotpose::cli
