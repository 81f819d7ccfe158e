/// Output lines as lists of named values, written as JSON or CSV.
#pragma once

#include <string>
#include <vector>

#include "dotpose/fix.hpp"

namespace dotpose::cli {

/// Format of output lines. Only `locate` writes text.
enum class RecordFormat { json, csv, text };

/// Version of the JSON lines, the first field of each line. docs/schema/lines-VERSION.json
/// describes the lines. Within a version, keys may be added. No key is removed, and no key
/// changes its meaning.
inline constexpr const char* kSchemaVersion = "1";

struct Field {
    std::string name;
    std::string text;  ///< empty if the field has no value in this line
    bool is_string = false;
    /// Name of the JSON array that contains the field. Adjacent fields with the same name form one
    /// array. In CSV, each field is a column.
    std::string array = {};
    /// True if JSON contains null, instead of omitting the field, if `text` is empty.
    bool is_null_if_empty = false;
};

/// Formats a number. Returns an empty text for NaN and infinity, which JSON cannot represent.
std::string decimal(double value, int decimals);

/// Formats an angle in degrees. The result is in (-180, 180], also after rounding.
std::string degrees(double angle_rad);

/// Formats an upper bound of a probability with three digits, rounded up to remain an upper bound.
std::string p_wrong_text(double p_wrong);

/// Format fields as one line with a line break. JSON omits fields without a value, unless they are
/// null; CSV contains all columns. In JSON, bytes that are not UTF-8 are replaced.
std::string json_line(const std::vector<Field>& fields);
std::string csv_header(const std::vector<Field>& fields);
std::string csv_line(const std::vector<Field>& fields);
std::string line_of(const std::vector<Field>& fields, RecordFormat format);

}  // namespace dotpose::cli
