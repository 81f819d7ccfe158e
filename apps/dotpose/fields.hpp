/// Output lines as lists of named values, written as JSON or CSV.
#pragma once

#include <string>
#include <vector>

#include "dotpose/fix.hpp"

namespace dotpose::cli {

/// Format of output lines. Only `locate` supports text.
enum class RecordFormat { json, csv, text };

/// Version of the JSON line format, written as the first field of each line.
/// docs/schema/lines-VERSION.json describes the format. Within a version, keys may be added, but
/// existing keys are never removed and never change their meaning.
inline constexpr const char* kSchemaVersion = "1";

struct Field {
    std::string name;
    std::string text;  ///< empty if the field has no value in this line
    bool is_string = false;
    /// Name of the JSON array that contains the field. Adjacent fields with the same array name
    /// form one array. In CSV, each field is a separate column.
    std::string array = {};
    /// True if an empty field is written to JSON as null. If false, an empty field is omitted.
    bool is_null_if_empty = false;
};

/// Formats a number. Returns an empty string for NaN and infinity, which JSON cannot represent.
std::string decimal(double value, int decimals);

/// Formats an element of a covariance matrix with a fixed number of significant digits, because the
/// elements of a matrix may differ by many powers of ten. Converts -0 to 0. Returns an empty string
/// for NaN and infinity.
std::string significant(double value);

/// Formats an angle in degrees. The result is in (-180, 180], even after rounding.
std::string degrees(double angle_rad);

/// Formats an upper bound on a probability with three significant digits. The bound is rounded up,
/// and is at least 1e-30.
std::string p_wrong_text(double p_wrong);

/// Formats fields as one line, including the line break. In JSON, an empty field is null or
/// omitted, depending on `is_null_if_empty`, and invalid UTF-8 bytes are replaced. CSV always
/// contains all columns.
std::string json_line(const std::vector<Field>& fields);
std::string csv_header(const std::vector<Field>& fields);
std::string csv_line(const std::vector<Field>& fields);
std::string line_of(const std::vector<Field>& fields, RecordFormat format);

}  // namespace dotpose::cli
