/// Text of strangers (from files, file names and networks), made fit for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace dotpose::print {

/// The text with U+FFFD in place of every byte that is no UTF-8 and of every character that moves
/// the cursor, starts a terminal command, breaks the line or changes the direction of writing, so
/// that it can neither act on a terminal nor pass for another line.
std::string printable(std::string_view text);

/// JSON text with the control characters that JSON may hold as they are (U+007F to U+009F) as \u
/// escapes: the value stays the same, and a terminal does not act on it.
std::string with_escaped_controls(std::string_view json);

}  // namespace dotpose::print
