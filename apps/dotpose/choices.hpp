/// Options whose value is one of a few names.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// Returns a validator that accepts only `names`. For any other value, the error message lists the
/// valid names and suggests the most similar one.
Validator one_of(const std::vector<std::string>& names);

/// Joins the names into "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

}  // namespace dotpose::cli
