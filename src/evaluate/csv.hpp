/// Reads and writes tables of comma-separated values.
#pragma once

#include <string>
#include <vector>

namespace dotpose::csv {

/// Splits a line into cells according to RFC 4180, except that cells cannot contain line breaks.
/// Quoted cells may contain commas and doubled quotes. Spaces are preserved. The result has at
/// least one cell, which may be empty.
std::vector<std::string> cells_of(const std::string& line);

/// Formats a string as a cell. If the string contains a comma or a quote, encloses it in quotes and
/// doubles the quotes in it.
std::string quoted(const std::string& text);

}  // namespace dotpose::csv
