/// Messages on the terminal, which may contain text from files, file names or networks, and colour.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "base/printable.hpp"

namespace dotpose::cli {

using base::printable;
using base::with_escaped_controls;

/// Writes to standard error, after what standard output still holds. Unlike fmt::print, it does not
/// throw if the stream is closed.
void write_to_stderr(const std::string& text);

/// Writes "dotpose: MESSAGE" to standard error, as one printable line.
void tell(std::string_view message);

/// Writes the message why the program ends, like `tell`, but where colour is wanted in red.
void tell_failure(std::string_view message);

/// Whether the stream is a terminal that shows colours and the user has not refused them:
/// no NO_COLOR (no-color.org), and TERM is not "dumb".
bool wants_colour(std::FILE* stream);

/// Returns the report with colour at the beginning of the lines that report a fault, a note or a
/// good result.
std::string in_colour(const std::string& report);

/// Returns `in_colour(report)` if standard output wants colour, else the report.
std::string for_standard_output(const std::string& report);

}  // namespace dotpose::cli
