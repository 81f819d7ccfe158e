#include "files/sheet_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "base/printable.hpp"

namespace dotpose {
namespace {

constexpr double kMinPrintScale = 0.5;
constexpr double kMaxPrintScale = 2;

/// A range of cells along one axis, from `first` to `end` - 1.
struct Range {
    std::int64_t first = 0;
    std::int64_t end = 0;
};

Range columns_of(const Sheet& sheet) {
    return {sheet.origin.x, std::int64_t{sheet.origin.x} + sheet.columns};
}
Range rows_of(const Sheet& sheet) {
    return {sheet.origin.y, std::int64_t{sheet.origin.y} + sheet.rows};
}
bool overlap(Range a, Range b) {
    return a.first < b.end && b.first < a.end;
}
/// Extends a range by the required gap on both sides.
Range with_gap(Range range) {
    return {range.first - kSheetGap_cells, range.end + kSheetGap_cells};
}

void validate_name(const std::string& name) {
    if (name.empty()) throw BadArgument("a sheet needs a name that is not empty");
    try {
        (void)nlohmann::json(name).dump();
    } catch (const nlohmann::json::exception&) {
        throw BadArgument("the name of a sheet must be text in UTF-8");
    }
    if (base::printable(name) != name) {
        throw BadArgument(
            "the name of a sheet must not contain control characters, or characters that break the "
            "line or change the writing direction");
    }
}

/// Returns the leftmost column at which `columns` columns are free in the given rows, or an empty
/// optional if there is none.
std::optional<std::uint32_t> free_column(const std::vector<SheetEntry>& sheets, Range rows,
                                         int columns) {
    std::vector<Range> taken;
    for (const SheetEntry& entry : sheets) {
        if (overlap(with_gap(rows_of(entry.sheet)), rows))
            taken.push_back(with_gap(columns_of(entry.sheet)));
    }
    std::ranges::sort(taken, {}, &Range::first);
    std::int64_t x = kSheetGap_cells;
    for (const Range& range : taken) {
        if (range.first >= x + columns) break;
        x = std::max(x, range.end);
    }
    if (x + columns + kSheetGap_cells > kPositionsPerAxis) return std::nullopt;
    return static_cast<std::uint32_t>(x);
}

void validate(const SheetPrint& print) {
    if (print.pages < 1) {
        throw BadArgument(fmt::format("{} pages: a document has 1 or more", print.pages));
    }
    if (!(print.dpi > 0 && std::isfinite(print.dpi))) {
        throw BadArgument(fmt::format("{:g} dpi: a resolution is above 0", print.dpi));
    }
    if (print.dots != "auto" && print.dots != "glyphs" && print.dots != "strokes") {
        throw BadArgument(
            fmt::format("dots drawn as '{}': it must be auto, glyphs or strokes", print.dots));
    }
}

}  // namespace

void validate(const SheetEntry& entry) {
    validate_name(entry.name);
    if (entry.page < 1) {
        throw BadArgument(fmt::format("page {}: the number must be 1 or more", entry.page));
    }
    for (const double scale : {entry.print_scale_x, entry.print_scale_y}) {
        if (scale >= kMinPrintScale && scale <= kMaxPrintScale) continue;
        throw BadArgument(fmt::format("a print scale of {:g}: it must be {:g} to {:g}", scale,
                                      kMinPrintScale, kMaxPrintScale));
    }
    if (const auto& world = entry.world) {
        for (const double value : {world->x_m, world->y_m, world->yaw_rad}) {
            if (!std::isfinite(value)) throw BadArgument("the world pose must be finite numbers");
        }
    }
    if (entry.print) validate(*entry.print);
    validate(entry.sheet);
}

bool overlap(const Sheet& a, const Sheet& b) {
    const auto is_microdots = [](const Sheet& sheet) {
        return sheet.pattern.code == CodeVariant::microdots;
    };
    return is_microdots(a) == is_microdots(b) && a.pattern.section == b.pattern.section &&
           overlap(columns_of(a), columns_of(b)) && overlap(rows_of(a), rows_of(b));
}

void files::check_beside(const SheetEntry& entry, const std::vector<SheetEntry>& sheets,
                         const SheetEntry* ignored) {
    validate(entry);
    for (const SheetEntry& other : sheets) {
        if (&other == ignored) continue;
        if (other.name == entry.name) {
            throw BadArgument(fmt::format("there already is a sheet '{}'{}", entry.name,
                                          other.is_reserved
                                              ? ", reserved by a print that is running or was "
                                                "stopped: its page may exist, so take another name"
                                              : ""));
        }
        if (overlap(entry.sheet, other.sheet)) {
            const Range columns = columns_of(other.sheet);
            const Range rows = rows_of(other.sheet);
            throw BadArgument(fmt::format(
                "sheet '{}' would share cells with sheet '{}', which has {},{} to {},{}",
                entry.name, other.name, columns.first, rows.first, columns.end - 1, rows.end - 1));
        }
    }
}

void files::append(const SheetEntry& entry, std::vector<SheetEntry>& sheets) {
    check_beside(entry, sheets);
    sheets.push_back(entry);
}

Cell files::free_origin(const std::vector<SheetEntry>& sheets, int columns, int rows) {
    // The topmost free region begins one gap below the top of the plane or one gap below another
    // region.
    std::set<std::int64_t> tops = {kSheetGap_cells};
    for (const SheetEntry& entry : sheets)
        tops.insert(with_gap(rows_of(entry.sheet)).end);
    for (const std::int64_t top : tops) {
        if (top + rows + kSheetGap_cells > kPositionsPerAxis) break;
        if (const auto x = free_column(sheets, {top, top + rows}, columns)) {
            return {*x, static_cast<std::uint32_t>(top)};
        }
    }
    throw BadArgument(fmt::format("no free region of {} x {} cells is left", columns, rows));
}

}  // namespace dotpose
