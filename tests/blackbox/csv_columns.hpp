/// Finds the value in a JSON line that corresponds to a column of a CSV line.
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

namespace dotpose::test {

/// Returns null if the JSON line has no value for the column.
inline nlohmann::json value_in(const nlohmann::json& line, const std::string& column) {
    if (line.contains(column)) return line[column];
    if (column == "section_u" && line.contains("section")) return line["section"][0];
    if (column == "section_v" && line.contains("section")) return line["section"][1];
    // For example, covariance_mm_deg_12 is row 1, column 2 (zero-based) of a 3 x 3 matrix.
    const std::size_t at = column.rfind('_');
    const std::string name = column.substr(0, at);
    if (at == std::string::npos || column.size() != at + 3 || !line.contains(name)) return {};
    const auto digit = [&](std::size_t i) { return static_cast<std::size_t>(column[i] - '0'); };
    return line[name].at(3 * digit(at + 1) + digit(at + 2));
}

}  // namespace dotpose::test
