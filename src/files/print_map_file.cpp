// Reads print maps from files, and compares them with sheets.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "dotpose/files/print_map.hpp"
#include "files/input_file.hpp"

namespace dotpose {
namespace {

/// Returns true if this page of the print map is a print of the sheet.
bool is_page(const MapPage& page, const SheetEntry& entry) {
    const Sheet& sheet = entry.sheet;
    return page.code == sheet.pattern.code && page.section == sheet.pattern.section &&
           page.origin == sheet.origin && page.columns == sheet.columns &&
           page.rows == sheet.rows &&
           std::abs(page.spacing_mm / sheet.pattern.spacing_mm - 1) < 1e-9;
}

}  // namespace

PrintMap read_print_map(const std::filesystem::path& path) {
    const auto text = files::text_of(path, kMaxMapBytes);
    if (!text) throw Error(fmt::format("{} does not exist", path.string()));
    try {
        return parse_print_map(*text);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", path.string(), error.what()));
    }
}

void require_pages(const PrintMap& map, std::span<const SheetEntry> sheets) {
    for (const MapPage& page : map.pages) {
        if (std::ranges::any_of(sheets, [&](const auto& entry) { return is_page(page, entry); }))
            continue;
        throw Error(
            fmt::format("the print map is of page '{}', which is not in the sheet file with the "
                        "same code, region and spacing: make a map of the pages of this file",
                        page.name));
    }
}

}  // namespace dotpose
