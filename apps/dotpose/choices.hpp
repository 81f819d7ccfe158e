/// Options that accept one of a few names.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// Returns a validator that accepts only `names`. For any other value, the error message lists the
/// names and suggests the most similar one.
Validator one_of(const std::vector<std::string>& names);

/// Joins the names as "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

}  // namespace dotpose::cli
