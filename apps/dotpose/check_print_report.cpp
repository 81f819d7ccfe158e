#include "check_print_report.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "dotpose/files/code_names.hpp"
#include "dotpose/files/degrees.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

using nlohmann::ordered_json;

double rounded(double value, int decimals) {
    const double scale = std::pow(10, decimals);
    const double result = std::round(value * scale) / scale;
    return result == 0 ? 0 : result;  // converts -0 to 0
}

template <typename... Values>
void add(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
    text += '\n';
}

std::string where(const PrintField& field) {
    return fmt::format("cells {},{} to {},{} ({} x {}), section {},{}", field.origin.x,
                       field.origin.y,
                       field.origin.x + static_cast<std::uint32_t>(field.columns - 1),
                       field.origin.y + static_cast<std::uint32_t>(field.rows - 1), field.columns,
                       field.rows, field.pattern.section.u, field.pattern.section.v);
}

void add_field(std::string& text, const CheckedScan& scan, const PrintField& field) {
    add(text, "pattern     {}, spacing {:g} mm", where(field), field.pattern.spacing_mm);
    if (field.sheet) add(text, "sheet       {}", scan.sheets[*field.sheet].name);
    if (field.scale) {
        const PrintScale& scale = *field.scale;
        add(text, "scale       x {:.3f} %, y {:.3f} %", 100 * scale.scale_x, 100 * scale.scale_y);
        add(text, "rotation    {:.3f} degrees, skew {:.3f} degrees",
            rounded(scale.rotation_rad * kDegrees, 3), rounded(scale.skew_rad * kDegrees, 3));
    }
    if (const auto& ratio = field.scale_ratio) {
        add(text, "scale x/y   {:.2f} %, give or take {:.2f} %", 100 * ratio->x_over_y,
            100 * ratio->uncertainty);
    }
    add(text,
        "places      off by {:.4f} mm (rms per axis): single dots by {:.4f} mm, parts of the page "
        "by up to {:.3f} mm",
        field.residual_mm, field.scatter_mm, field.largest_distortion_mm);
    if (field.are_sizes_measured) {
        add(text, "dots        {:.4f} mm (nominal {:.4f} mm, gain {:+.0f} %), spread {:.4f} mm",
            field.dot_mm, field.pattern.dot_mm, 100 * field.gain(), field.dot_sigma_mm);
        add(text, "contrast    {:.0f} % of the paper's level {:.0f}", 100 * field.contrast,
            field.paper_level);
    }
    add(text, "covered     {} of {} ({:.2f} %), not counted below", field.covered,
        field.covered + field.cells, 100 * field.covered_fraction());
    if (field.are_dots_checked) {
        add(text, "missing     {} of {} ({:.2f} %)", field.missing, field.cells,
            100 * field.missing_fraction());
    }
    if (field.are_sizes_measured) {
        add(text, "merged      {} ({:.2f} %)", field.merged, 100 * field.merged_fraction());
    }
    add(text, "bits wrong  {} of {} ({:.2f} %)", field.bits_wrong, 2 * field.dots,
        100 * field.wrong_fraction());
}

/// Returns the prefix that identifies a field in the report. It has the form "sheet 'table': ", or
/// "from cell X,Y on: " if the sheet of the field is unknown. Returns an empty string if there is
/// only one field or if `index` has no value.
std::string about(const CheckedScan& scan, const PrintCheck& check,
                  std::optional<std::size_t> index) {
    if (!index || check.fields.size() == 1) return "";
    const PrintField& field = check.fields[*index];
    if (field.sheet) return fmt::format("sheet '{}': ", scan.sheets[*field.sheet].name);
    return fmt::format("from cell {},{} on: ", field.origin.x, field.origin.y);
}

/// Returns the indices of the patches, sorted by spacing and then by dot diameter.
std::vector<std::size_t> patches_in_order(const PrintCheck& check) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < check.fields.size(); ++i) {
        if (check.fields[i].is_patch) order.push_back(i);
    }
    std::ranges::sort(order, {}, [&](std::size_t i) {
        const Pattern& pattern = check.fields[i].pattern;
        return std::pair(pattern.spacing_mm, pattern.dot_mm);
    });
    return order;
}

bool is_best(const PrintCheck& check, std::size_t index) {
    return std::ranges::count(check.best_per_spacing, index) > 0;
}

void add_patches(std::string& text, const PrintCheck& check) {
    add(text, "test page: {} patches were read, lengths in mm", patches_in_order(check).size());
    add(text, "{:>8} {:>8} {:>8} {:>8} {:>9} {:>8} {:>9} {:>9}", "spacing", "dot", "printed",
        "gain", "missing", "merged", "bits", "residual");
    for (const std::size_t i : patches_in_order(check)) {
        const PrintField& f = check.fields[i];
        add(text, "{:8.4f} {:8.4f} {:8.4f} {:+7.0f}% {:8.2f}% {:7.2f}% {:8.2f}% {:9.4f}{}",
            f.pattern.spacing_mm, f.pattern.dot_mm, f.dot_mm, 100 * f.gain(),
            100 * f.missing_fraction(), 100 * f.merged_fraction(), 100 * f.wrong_fraction(),
            f.residual_mm, is_best(check, i) ? "  best for this spacing" : "");
    }
    for (const Pattern& pattern : check.unread_patches)
        add(text, "{:8.4f} {:8.4f} could not be read", pattern.spacing_mm, pattern.dot_mm);
}

ordered_json json_of(const CheckedScan& scan, const PrintField& field) {
    ordered_json object;
    if (field.sheet) object["sheet"] = scan.sheets[*field.sheet].name;
    object.update({
        {"spacing_mm", rounded(field.pattern.spacing_mm, 6)},
        {"dot_mm", rounded(field.pattern.dot_mm, 6)},
        {"section", {field.pattern.section.u, field.pattern.section.v}},
        {"origin", {field.origin.x, field.origin.y}},
        {"columns", field.columns},
        {"rows", field.rows},
        {"spacing_px", rounded(field.spacing_px, 4)},
    });
    if (field.scale) {
        object["scale_x"] = rounded(field.scale->scale_x, 7);
        object["scale_y"] = rounded(field.scale->scale_y, 7);
        object["rotation_deg"] = rounded(field.scale->rotation_rad * kDegrees, 5);
        object["skew_deg"] = rounded(field.scale->skew_rad * kDegrees, 5);
    }
    if (field.scale_ratio) {
        object["scale_x_over_y"] = rounded(field.scale_ratio->x_over_y, 5);
        object["scale_x_over_y_uncertainty"] = rounded(field.scale_ratio->uncertainty, 5);
    }
    object["residual_mm"] = rounded(field.residual_mm, 6);
    object["scatter_mm"] = rounded(field.scatter_mm, 6);
    object["largest_distortion_mm"] = rounded(field.largest_distortion_mm, 6);
    object["printed_dot_mm"] = rounded(field.dot_mm, 6);
    object["printed_dot_sigma_mm"] = rounded(field.dot_sigma_mm, 6);
    object["gain"] = rounded(field.gain(), 4);
    object["contrast"] = rounded(field.contrast, 4);
    object["paper_level"] = rounded(field.paper_level, 1);
    object["covered"] = field.covered;
    object["cells"] = field.cells;
    object["dots"] = field.dots;
    object["missing"] = field.missing;
    object["merged"] = field.merged;
    object["bits_wrong"] = field.bits_wrong;
    object["sizes_measured"] = field.are_sizes_measured;
    object["dots_checked"] = field.are_dots_checked;
    return object;
}

ordered_json json_of(const Pattern& pattern) {
    return {{"spacing_mm", rounded(pattern.spacing_mm, 6)}, {"dot_mm", rounded(pattern.dot_mm, 6)}};
}

/// Returns a remark to append to the name of a detected code, or an empty string if the probability
/// that the code is wrong is below 1 %.
std::string code_remark(const PrintCheck& check) {
    constexpr double kDoubtful = 0.01;
    if (check.code_p_wrong < kDoubtful) return "";
    return fmt::format(" (or another one: too few dots to decide; probability {:.2g})",
                       check.code_p_wrong);
}

const char* status_of(const PrintCheck& check) {
    if (check.is_mirrored) return "mirrored";
    return check.fields.empty() ? "no_pattern" : "ok";
}

}  // namespace

std::string text_report(const CheckedScan& scan, const PrintCheck& check) {
    std::string text;
    add(text, "{}: {} x {} px{}", printable(scan.file), scan.width_px, scan.height_px,
        check.resolution ? fmt::format(", {:g} dpi", std::round(check.resolution->x_dpi)) : "");
    if (scan.pages > 1) {
        add(text, "page        {} of {}: --page N checks another one", scan.page, scan.pages);
    }
    if (check.fields.empty()) {
        add(text, "{}",
            check.is_mirrored ? "the pattern is mirrored: check it with --flip"
                              : "no pattern was found in this image");
    } else {
        add(text, "code        {}{}", name(check.code), code_remark(check));
    }
    if (check.is_test_page) {
        add_patches(text, check);
    } else {
        for (const PrintField& field : check.fields)
            add_field(text, scan, field);
    }
    for (const Finding& finding : check.findings) {
        add(text, "{} {}{}",
            finding.is_fault ? "FAULT:" : "note: ", about(scan, check, finding.field),
            finding.text);
    }
    return text;
}

std::string json_report(const CheckedScan& scan, const PrintCheck& check) {
    ordered_json object = {
        {"file", scan.file},
        {"status", status_of(check)},
        {"width_px", scan.width_px},
        {"height_px", scan.height_px},
        {"test_page", check.is_test_page},
        {"page", scan.page},
        {"pages", scan.pages},
    };
    if (!check.fields.empty()) {
        object["code"] = name(check.code);
        object["code_p_wrong"] = rounded(check.code_p_wrong, 9);
    }
    if (check.resolution) {
        object["x_dpi"] = rounded(check.resolution->x_dpi, 3);
        object["y_dpi"] = rounded(check.resolution->y_dpi, 3);
    }
    if (check.is_photo) object["exif_of_camera"] = true;
    if (check.camera) {
        object["camera"] = {{"perspective", rounded(check.camera->perspective, 5)},
                            {"lens", rounded(check.camera->lens, 5)}};
    }
    object["fields"] = ordered_json::array();
    for (const PrintField& field : check.fields)
        object["fields"].push_back(json_of(scan, field));
    if (!check.best_per_spacing.empty()) {
        object["best"] = json_of(check.fields[check.best].pattern);
        for (const std::size_t index : check.best_per_spacing)
            object["best_per_spacing"].push_back(json_of(check.fields[index].pattern));
    }
    for (const Pattern& pattern : check.unread_patches)
        object["unread"].push_back(json_of(pattern));
    object["findings"] = ordered_json::array();
    for (const Finding& finding : check.findings) {
        ordered_json& last = object["findings"].emplace_back(ordered_json{
            {"kind", name(finding.kind)}, {"fault", finding.is_fault}, {"text", finding.text}});
        if (finding.field) last["field"] = *finding.field;
    }
    return with_escaped_controls(
               object.dump(2, ' ', false, ordered_json::error_handler_t::replace)) +
           '\n';
}

}  // namespace dotpose::cli
