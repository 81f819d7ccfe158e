/// What the tool says on a terminal, with text of strangers in it.
#pragma once

#include <string_view>

#include "print/printable.hpp"

namespace dotpose::cli {

using print::printable;
using print::with_escaped_controls;

/// "dotpose: MESSAGE" on standard error, as one printable line.
void tell(std::string_view message);

}  // namespace dotpose::cli
