/// Makes text from files, file names and the network safe to display on a terminal.
#pragma once

#include <string>
#include <string_view>

#include "dotpose/export.hpp"

// These functions are exported because the tools library uses them.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::base {

/// Replaces unsafe bytes and characters with U+FFFD. Bytes are unsafe if they are not valid UTF-8.
/// Characters are unsafe if they move the cursor, start a terminal command, break the line or
/// change the text direction. The result can neither control a terminal nor imitate another line of
/// output.
std::string printable(std::string_view text);

/// Replaces the control characters U+007F to U+009F in JSON text with \u escapes, because a
/// terminal may interpret them. The escapes do not change the JSON value.
std::string with_escaped_controls(std::string_view json);

}  // namespace dotpose::base

DOTPOSE_END_EXPORT
