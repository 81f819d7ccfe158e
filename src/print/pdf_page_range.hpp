/// Parses and formats lists of page numbers.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace dotpose::print {

/// Parses a list of page numbers such as "1-3,7". "z" is the last of `count` pages, and an empty
/// string means all pages. Throws BadArgument if the list is invalid.
std::set<int> page_numbers(const std::string& range, int count);

/// Formats page numbers, for example as "pages 1, 2, 5". Long lists are shortened.
std::string page_list(const std::vector<int>& numbers);

}  // namespace dotpose::print
