/// Reads and writes tables of comma-separated values.
#pragma once

#include <string>
#include <vector>

namespace dotpose::csv {

/// Splits a line into cells according to RFC 4180. Quoted cells may contain commas and doubled
/// quotes, but no line breaks. Preserves spaces. The result has at least one cell, which may be
/// empty.
std::vector<std::string> cells_of(const std::string& line);

/// Formats a text as a cell. The cell is quoted if the text contains a comma or a quote.
std::string quoted(const std::string& text);

}  // namespace dotpose::csv
