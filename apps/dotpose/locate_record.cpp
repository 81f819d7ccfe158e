#include "locate_record.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "dotpose/locate.hpp"

namespace dotpose::cli {
namespace {

/// A smaller probability would be no statement about paper, ink and cameras any more.
constexpr double kLeast_p_wrong = 1e-30;

struct Field {
    const char* name;
    std::string text;  ///< empty: means nothing for this frame
    bool is_string = false;
};

/// Empty for what is no number, which JSON cannot express.
std::string decimal(double value, int decimals) {
    if (!std::isfinite(value)) return {};
    std::string text = fmt::format("{:.{}f}", value, decimals);
    const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
    return is_zero && text.front() == '-' ? text.substr(1) : text;
}

/// In (-180, 180], also after rounding to the decimals shown.
std::string degrees(double angle_rad) {
    constexpr int kDecimals = 6;
    const double angle_deg = std::round(angle_rad * 180 / std::numbers::pi * 1e6) / 1e6;
    return decimal(angle_deg <= -180 ? angle_deg + 360 : angle_deg, kDecimals);
}

std::string p_wrong(const Fix& fix) {
    // It is an upper bound, so three digits are rounded up.
    return fmt::format("{:.3g}", std::max(fix.p_wrong() * 1.005, kLeast_p_wrong));
}

double sigma(const Fix& fix, std::size_t axis) {
    return std::sqrt(static_cast<double>(fix.covariance[axis][axis]));
}

/// What `--sheets` adds.
std::vector<Field> sheet_fields(const std::optional<SheetPlace>& place) {
    std::vector<Field> fields = {
        {"sheet", {}, true}, {"x_sheet_mm", {}}, {"y_sheet_mm", {}},
        {"x_m", {}},         {"y_m", {}},        {"yaw_rad", {}},
    };
    if (!place) return fields;
    fields[0].text = place->entry->name;
    fields[1].text = decimal(place->x_mm, 6);
    fields[2].text = decimal(place->y_mm, 6);
    if (const auto world = world_pose(*place)) {
        fields[3].text = decimal(world->x_m, 9);
        fields[4].text = decimal(world->y_m, 9);
        fields[5].text = decimal(world->yaw_rad, 8);
    }
    return fields;
}

/// The single list of fields, in the order of the output. `section` is one field in JSON.
std::vector<Field> fields(const Record& record) {
    const Fix& fix = record.fix;
    const double spacing_mm = record.spacing_mm;
    const bool ok = fix.status == Status::ok;
    const auto if_ok = [ok](std::string text) { return ok ? std::move(text) : std::string(); };
    const auto if_judged = [&](double value, int decimals) {
        return ok && fix.has_covariance() ? decimal(value, decimals) : std::string();
    };
    std::vector<Field> fields = {
        {"file", record.file, true},
        {"status", name(fix.status), true},
        {"message", reason(record), true},
        {"x_mm", if_ok(decimal(fix.x_mm(spacing_mm), 6))},
        {"y_mm", if_ok(decimal(fix.y_mm(spacing_mm), 6))},
        {"theta_deg", if_ok(degrees(fix.theta_rad()))},
        {"x_grid", if_ok(decimal(fix.x_grid(), 6))},
        {"y_grid", if_ok(decimal(fix.y_grid(), 6))},
        {"section_u", if_ok(fmt::format("{}", fix.section.u))},
        {"section_v", if_ok(fmt::format("{}", fix.section.v))},
        {"dots_seen", fmt::format("{}", fix.dots_seen)},
        {"dots_used", if_ok(fmt::format("{}", fix.dots_used))},
        {"bit_errors", if_ok(fmt::format("{}", fix.bit_errors))},
        {"p_wrong", if_ok(p_wrong(fix))},
        {"sigma_x_mm", if_judged(sigma(fix, 0) * spacing_mm, 6)},
        {"sigma_y_mm", if_judged(sigma(fix, 1) * spacing_mm, 6)},
        {"sigma_theta_deg", if_judged(sigma(fix, 2) * 180 / std::numbers::pi, 6)},
        {"residual_px", if_judged(static_cast<double>(fix.residual_px), 4)},
        {"spacing_px", if_ok(decimal(fix.spacing_px(), 4))},
        {"elapsed_us", decimal(record.elapsed_us, 1)},
    };
    if (record.has_sheets) {
        for (Field& field : sheet_fields(record.place))
            fields.push_back(std::move(field));
    }
    return fields;
}

std::string json_string(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string csv_string(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

}  // namespace

std::string reason(const Record& record) {
    const Fix& fix = record.fix;
    switch (fix.status) {
        case Status::ok:
            return {};
        case Status::image_too_small:
            return fmt::format("the image is {} x {} px; at least {} x {} are needed",
                               record.width_px, record.height_px, kMinFrameSide_px,
                               kMinFrameSide_px);
        case Status::image_too_large:
            return fmt::format("the image is {} x {} px; at most {} x {} can be located",
                               record.width_px, record.height_px, kMaxFrameSide_px,
                               kMaxFrameSide_px);
        case Status::too_few_dots:
            return fmt::format("found {} dots; at least {} are needed", fix.dots_seen,
                               record.min_dots);
        case Status::not_certain:
            return fmt::format("{}: {} bits of {} dots contradict the best position",
                               message(fix.status), fix.bit_errors, fix.dots_seen);
        default:
            return message(fix.status);
    }
}

std::string json_line(const Record& record) {
    std::string line = "{";
    std::string section_u;
    for (const Field& field : fields(record)) {
        if (field.text.empty()) continue;
        const std::string_view name = field.name;
        if (name == "section_u") {
            section_u = field.text;
            continue;
        }
        if (line.size() > 1) line += ',';
        if (name == "section_v") {
            line += fmt::format("\"section\":[{},{}]", section_u, field.text);
        } else {
            line += fmt::format("\"{}\":{}", name,
                                field.is_string ? json_string(field.text) : field.text);
        }
    }
    return line + "}\n";
}

std::string csv_header(bool has_sheets) {
    std::string line;
    Record record;
    record.has_sheets = has_sheets;
    for (const Field& field : fields(record)) {
        if (!line.empty()) line += ',';
        line += field.name;
    }
    return line + '\n';
}

std::string csv_line(const Record& record) {
    std::string line;
    for (const Field& field : fields(record)) {
        line += field.is_string ? csv_string(field.text) : field.text;
        line += ',';
    }
    line.back() = '\n';
    return line;
}

}  // namespace dotpose::cli
