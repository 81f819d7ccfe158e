/// Options whose value is one of a few names.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// Returns the check that a value is one of `names`. The refusal lists them and suggests the
/// nearest.
Validator one_of(const std::vector<std::string>& names);

/// Returns "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

}  // namespace dotpose::cli
