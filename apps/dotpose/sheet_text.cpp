#include "sheet_text.hpp"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "common.hpp"
#include "sheet_changes.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

/// Formats a number with at most `decimals` decimal places and without trailing zeros. Converts -0
/// to 0.
std::string short_number(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string cells_text(const Sheet& sheet) {
    return fmt::format("{},{} to {},{}", sheet.origin.x, sheet.origin.y,
                       sheet.origin.x + static_cast<std::uint32_t>(sheet.columns - 1),
                       sheet.origin.y + static_cast<std::uint32_t>(sheet.rows - 1));
}

std::string page_text(const Sheet& sheet) {
    return fmt::format("{:g} x {:g} mm", sheet.width_mm, sheet.height_mm);
}

std::string print_text(const SheetEntry& entry) {
    if (!entry.print) return fmt::format("page {} of its document", entry.page);
    const SheetPrint& print = *entry.print;
    return fmt::format("page {} of {} of '{}', for {:g} dpi{}", entry.page, print.pages,
                       printable(print.title), print.dpi,
                       print.document.empty()
                           ? ""
                           : fmt::format(", over the document {}", printable(print.document)));
}

}  // namespace

const SheetEntry& named_sheet(const std::vector<SheetEntry>& sheets, const std::string& name,
                              const std::string& file) {
    const auto found = std::ranges::find(sheets, name, &SheetEntry::name);
    if (found != sheets.end()) return *found;
    constexpr std::size_t kMaxNames = 12;
    std::string names;
    for (std::size_t i = 0; i < std::min(sheets.size(), kMaxNames); ++i)
        names += (names.empty() ? "" : ", ") + sheets[i].name;
    if (sheets.size() > kMaxNames) {
        names += fmt::format(" and {} more, which 'dotpose sheets list' shows",
                             sheets.size() - kMaxNames);
    }
    throw BadArgument(fmt::format("{} has no sheet '{}'; it has {}", file, name,
                                  names.empty() ? "no sheets" : names));
}

std::optional<CodeVariant> common_code(const std::string& file,
                                       const std::vector<SheetEntry>& sheets) {
    if (sheets.empty()) throw Error(fmt::format("{} has no sheets", file));
    const CodeVariant code = sheets.front().sheet.pattern.code;
    const bool is_common = std::ranges::all_of(
        sheets, [&](const SheetEntry& entry) { return entry.sheet.pattern.code == code; });
    return is_common ? std::optional(code) : std::nullopt;
}

std::string world_text(const SheetEntry& entry) {
    const std::optional<PagePose> pose = page_pose(entry);
    if (!pose) return "its pose in the world is not known";
    return fmt::format("its top left corner is at x {} mm, y {} mm in the world, yaw {} deg",
                       short_number(pose->x_mm, 3), short_number(pose->y_mm, 3),
                       short_number(pose->yaw_deg, 4));
}

std::string removal_text(const std::string& name) {
    return fmt::format(
        "{} is removed: its cells may be given to other pages, so do not use its page any more",
        printable(name));
}

std::string list_text(const std::vector<SheetEntry>& sheets) {
    constexpr std::size_t kColumns = 6;
    std::vector<std::array<std::string, kColumns>> lines = {
        {"name", "page", "cells", "x [mm]", "y [mm]", "yaw [deg]"}};
    for (const SheetEntry& entry : sheets) {
        std::array<std::string, kColumns> line = {
            printable(entry.name), page_text(entry.sheet), cells_text(entry.sheet), "-", "-", "-"};
        if (const std::optional<PagePose> pose = page_pose(entry)) {
            line[3] = short_number(pose->x_mm, 3);
            line[4] = short_number(pose->y_mm, 3);
            line[5] = short_number(pose->yaw_deg, 4);
        }
        if (entry.is_reserved) line[5] += "  reserved";
        lines.push_back(line);
    }
    std::array<std::size_t, kColumns> widths{};
    for (const auto& line : lines) {
        for (std::size_t i = 0; i + 1 < kColumns; ++i)
            widths[i] = std::max(widths[i], line[i].size());
    }
    std::string text;
    for (const auto& line : lines) {
        for (std::size_t i = 0; i < kColumns; ++i)
            text += fmt::format("{:<{}}{}", line[i], widths[i], i + 1 < kColumns ? "  " : "\n");
    }
    return text;
}

std::string sheet_text(const SheetEntry& entry) {
    const Sheet& sheet = entry.sheet;
    const Pattern& pattern = sheet.pattern;
    std::string text;
    const auto line = [&text](const char* what, const std::string& value) {
        text += fmt::format("{:<26}{}\n", what, value);
    };
    line("name", printable(entry.name));
    line("page", page_text(sheet));
    line("cells", fmt::format("{} ({} x {})", cells_text(sheet), sheet.columns, sheet.rows));
    line("code, section",
         fmt::format("{}; {},{}", code_name(pattern.code), pattern.section.u, pattern.section.v));
    line("spacing", short_number(pattern.spacing_mm, 6) + " mm");
    line("displacement, dot", fmt::format("{} mm, {} mm", short_number(pattern.displacement_mm, 6),
                                          short_number(pattern.dot_mm, 6)));
    line("first intersection",
         fmt::format("{} mm right of and {} mm below the top left corner",
                     short_number(sheet.origin_x_mm, 4), short_number(sheet.origin_y_mm, 4)));
    line("print scale", fmt::format("x {}, y {}", short_number(entry.print_scale_x, 6),
                                    short_number(entry.print_scale_y, 6)));
    line("world", world_text(entry));
    line("printed", print_text(entry));
    if (entry.print) line("made again by", printable(entry.print->command));
    if (entry.is_reserved) line("reserved", "being printed, or the print was stopped");
    return text;
}

}  // namespace dotpose::cli
