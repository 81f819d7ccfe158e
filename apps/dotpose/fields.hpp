/// Lines of output as lists of named values, which are written as JSON or CSV.
#pragma once

#include <string>
#include <vector>

#include "dotpose/fix.hpp"

namespace dotpose::cli {

/// Format of output lines. Only `locate` supports text.
enum class RecordFormat { json, csv, text };

/// Version of the JSON lines, which is the first field of each line. docs/schema/lines-VERSION.json
/// describes the lines. Within a version, keys may be added, but are never removed and never change
/// their meaning.
inline constexpr const char* kSchemaVersion = "1";

struct Field {
    std::string name;
    std::string text;  ///< empty if the field has no value in this line
    bool is_string = false;
    /// Name of the JSON array that contains the field. Adjacent fields with the same name form one
    /// array. In CSV, each field is a column.
    std::string array = {};
    /// True if JSON contains null for an empty field. Otherwise, JSON omits the field.
    bool is_null_if_empty = false;
};

/// Formats a number. Returns an empty string for NaN and infinity, which JSON cannot represent.
std::string decimal(double value, int decimals);

/// Formats an element of a covariance with a fixed number of significant digits, because the
/// elements of one matrix differ by many powers of ten. Converts -0 to 0. Returns an empty string
/// for NaN and infinity.
std::string significant(double value);

/// Formats an angle in degrees. The result is in (-180, 180] even after rounding.
std::string degrees(double angle_rad);

/// Formats an upper bound of a probability with three digits, rounded up to remain an upper bound.
/// A bound below 1e-30 is formatted as 1e-30.
std::string p_wrong_text(double p_wrong);

/// Formats fields as one line that ends with a line break. In JSON, fields without a value are null
/// or omitted (`is_null_if_empty`), and invalid UTF-8 bytes are replaced. CSV contains all columns.
std::string json_line(const std::vector<Field>& fields);
std::string csv_header(const std::vector<Field>& fields);
std::string csv_line(const std::vector<Field>& fields);
std::string line_of(const std::vector<Field>& fields, RecordFormat format);

}  // namespace dotpose::cli
