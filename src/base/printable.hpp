/// Makes text from files, file names and networks safe to display on a terminal.
#pragma once

#include <string>
#include <string_view>

#include "dotpose/export.hpp"

// These functions are exported because the tools library uses them.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::base {

/// Returns the text with U+FFFD in place of unsafe bytes and characters. These are all bytes that
/// are not valid UTF-8, and all characters that move the cursor, start a terminal command, break
/// the line or change the writing direction. The result can neither control a terminal nor imitate
/// another line of output.
std::string printable(std::string_view text);

/// Returns JSON text in which \u escapes replace the control characters U+007F to U+009F. JSON
/// allows these characters unescaped, but a terminal may interpret them. The JSON value does not
/// change.
std::string with_escaped_controls(std::string_view json);

}  // namespace dotpose::base

DOTPOSE_END_EXPORT
