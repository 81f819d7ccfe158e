/// Numbers of pages as users write and read them.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace dotpose::print {

/// Parses page numbers such as "1-3,7"; "z" is the last of `count` pages, and an empty text means
/// all. Throws BadArgument.
std::set<int> page_numbers(const std::string& range, int count);

/// Lists page numbers as in "pages 1, 2, 5", but no more than the first few.
std::string page_list(const std::vector<int>& numbers);

}  // namespace dotpose::print
