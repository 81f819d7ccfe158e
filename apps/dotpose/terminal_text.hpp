/// Messages on the terminal, which may contain text from files, file names or networks.
#pragma once

#include <string_view>

#include "files/printable.hpp"

namespace dotpose::cli {

using files::printable;
using files::with_escaped_controls;

/// Writes "dotpose: MESSAGE" to standard error, as one printable line.
void tell(std::string_view message);

}  // namespace dotpose::cli
