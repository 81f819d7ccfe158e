/// Options whose value is one of a few names, and what these names are.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// Checks that a value is one of `names`; the message tells them all and the nearest one.
/// `earlier_names` are accepted too, and told nowhere.
Validator one_of(const std::vector<std::string>& names,
                 const std::vector<std::string>& earlier_names = {});

/// Returns "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

}  // namespace dotpose::cli
