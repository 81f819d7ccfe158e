/// Output lines as lists of named values, written as JSON or CSV.
#pragma once

#include <string>
#include <vector>

#include "dotpose/fix.hpp"

namespace dotpose::cli {

enum class RecordFormat { jsonl, csv };

struct Field {
    const char* name;
    std::string text;  ///< empty if the field has no value in this line
    bool is_string = false;
};

/// Formats a number; returns an empty text for NaN and infinity, which JSON cannot express.
std::string decimal(double value, int decimals);

/// Formats an angle in degrees, in (-180, 180] even after rounding.
std::string degrees(double angle_rad);

/// Formats the bound of a probability with three digits, rounded up so that it stays a bound.
std::string p_wrong_text(double p_wrong);

/// These functions return a line with its line break. JSON has only the fields with a value, CSV
/// has all columns. The fields section_u and section_v, in this order, become one field in JSON. In
/// JSON, bytes that are not UTF-8 are replaced.
std::string json_line(const std::vector<Field>& fields);
std::string csv_header(const std::vector<Field>& fields);
std::string csv_line(const std::vector<Field>& fields);

}  // namespace dotpose::cli
