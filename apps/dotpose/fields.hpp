/// Output lines as lists of named values, written as JSON or CSV.
#pragma once

#include <string>
#include <vector>

#include "dotpose/fix.hpp"

namespace dotpose::cli {

enum class RecordFormat { jsonl, csv };

struct Field {
    const char* name;
    std::string text;  ///< empty: means nothing in this line
    bool is_string = false;
};

/// Empty for what is no number, which JSON cannot express.
std::string decimal(double value, int decimals);

/// In (-180, 180], also after rounding to the decimals shown.
std::string degrees(double angle_rad);

/// A probability that is an upper bound, so three digits of it are rounded up.
std::string p_wrong_text(double p_wrong);

/// Lines with their line break. JSON holds the fields that mean something, CSV has all columns.
/// The fields section_u and section_v, in this order, are one in JSON. In JSON, bytes of a text
/// that are no UTF-8 are replaced.
std::string json_line(const std::vector<Field>& fields);
std::string csv_header(const std::vector<Field>& fields);
std::string csv_line(const std::vector<Field>& fields);

}  // namespace dotpose::cli
