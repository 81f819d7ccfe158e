/// Csv: reading tables of comma-separated values.
#pragma once

#include <string>
#include <vector>

namespace dotpose::csv {

/// The cells of a line (RFC 4180, without line breaks in cells): quoted ones may hold commas and
/// doubled quotes. Blanks are kept. At least one, which may be empty.
std::vector<std::string> cells_of(const std::string& line);

}  // namespace dotpose::csv
