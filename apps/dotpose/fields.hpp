/// Output lines as lists of named values, written as JSON or CSV.
#pragma once

#include <string>
#include <vector>

#include "dotpose/fix.hpp"

namespace dotpose::cli {

/// The format of output lines; only `locate` writes text.
enum class RecordFormat { json, csv, text };

/// The version of the JSON lines, which every line begins with. docs/schema/lines-VERSION.json
/// describes it. Within a version keys may be added, but none goes away or changes its meaning.
inline constexpr const char* kSchemaVersion = "1";

struct Field {
    std::string name;
    std::string text;  ///< empty if the field has no value in this line
    bool is_string = false;
    /// Name of the JSON array that the field is an element of. Neighbours with the same name make
    /// one array; in CSV they are columns of their own.
    std::string array = {};
};

/// Formats a number; returns an empty text for NaN and infinity, which JSON cannot express.
std::string decimal(double value, int decimals);

/// Formats an angle in degrees, in (-180, 180] even after rounding.
std::string degrees(double angle_rad);

/// Formats the bound of a probability with three digits, rounded up so that it stays a bound.
std::string p_wrong_text(double p_wrong);

/// These functions return a line with its line break. JSON has only the fields with a value, CSV
/// has all columns. In JSON, bytes that are not UTF-8 are replaced.
std::string json_line(const std::vector<Field>& fields);
std::string csv_header(const std::vector<Field>& fields);
std::string csv_line(const std::vector<Field>& fields);
std::string line_of(const std::vector<Field>& fields, RecordFormat format);

}  // namespace dotpose::cli
