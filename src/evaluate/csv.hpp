/// Reads and writes tables of comma-separated values.
#pragma once

#include <string>
#include <vector>

namespace dotpose::csv {

/// Splits a line into cells by RFC 4180, without line breaks in cells: quoted cells may contain
/// commas and doubled quotes. Spaces are kept. The result has at least one cell, which may be
/// empty.
std::vector<std::string> cells_of(const std::string& line);

/// Returns the text as a cell: in quotes if it contains a comma or a quote.
std::string quoted(const std::string& text);

}  // namespace dotpose::csv
