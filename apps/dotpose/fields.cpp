#include "fields.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

std::string json_string(const std::string& text) {
    return with_escaped_controls(
        nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string csv_string(const std::string& text) {
    const std::string shown = printable(text);
    if (shown.find_first_of(",\"") == std::string::npos) return shown;
    std::string quoted = "\"";
    for (const char c : shown) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

std::string json_value(const Field& field) {
    if (field.text.empty()) return "null";
    return field.is_string ? json_string(field.text) : field.text;
}

}  // namespace

std::string decimal(double value, int decimals) {
    if (!std::isfinite(value)) return {};
    std::string text = fmt::format("{:.{}f}", value, decimals);
    const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
    return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::string significant(double value) {
    return std::isfinite(value) ? fmt::format("{:.7g}", value + 0.0) : std::string();
}

std::string degrees(double angle_rad) {
    constexpr int kDecimals = 6;
    const double angle_deg = std::round(angle_rad * 180 / std::numbers::pi * 1e6) / 1e6;
    return decimal(angle_deg <= -180 ? angle_deg + 360 : angle_deg, kDecimals);
}

std::string p_wrong_text(double p_wrong) {
    // Minimum probability that is reported. The model of paper, ink and camera is not accurate
    // enough to justify smaller values.
    constexpr double kMin_p_wrong = 1e-30;
    return fmt::format("{:.3g}", std::max(p_wrong * 1.005, kMin_p_wrong));
}

std::string json_line(const std::vector<Field>& fields) {
    std::string line = "{";
    std::string_view open_array;
    for (const Field& field : fields) {
        if (field.text.empty() && !field.is_null_if_empty) continue;
        const std::string value = json_value(field);
        if (!open_array.empty() && field.array == open_array) {
            line += ',' + value;
            continue;
        }
        if (!open_array.empty()) line += ']';
        open_array = field.array;
        if (line.size() > 1) line += ',';
        line += open_array.empty() ? fmt::format("\"{}\":{}", field.name, value)
                                   : fmt::format("\"{}\":[{}", field.array, value);
    }
    return line + (open_array.empty() ? "}\n" : "]}\n");
}

std::string csv_header(const std::vector<Field>& fields) {
    std::string line;
    for (const Field& field : fields) {
        if (!line.empty()) line += ',';
        line += field.name;
    }
    return line + '\n';
}

std::string csv_line(const std::vector<Field>& fields) {
    std::string line;
    for (const Field& field : fields) {
        line += field.is_string ? csv_string(field.text) : field.text;
        line += ',';
    }
    line.back() = '\n';
    return line;
}

std::string line_of(const std::vector<Field>& fields, RecordFormat format) {
    return format == RecordFormat::csv ? csv_line(fields) : json_line(fields);
}

}  // namespace dotpose::cli
