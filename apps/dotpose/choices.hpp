/// Options whose value is one of a few names, and what these names are.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace dotpose::cli {

/// Checks that a value is one of `names`; the message tells them all and the nearest one.
/// `earlier_names` are accepted too, and told nowhere.
CLI::Validator one_of(const std::vector<std::string>& names,
                      const std::vector<std::string>& earlier_names = {});

/// Returns the names that `one_of` accepts as values of the option; none if it takes other values.
std::vector<std::string> choices_of(CLI::Option& option);

/// Returns "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

}  // namespace dotpose::cli
