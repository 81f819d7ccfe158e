#include "calibrate/sheet_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "dotpose/files/sheet_place.hpp"

namespace dotpose::calibrate {

double printed_spacing_mm(const CalibrateOptions& options, CodeVariant code,
                          const std::vector<Place>& places) {
    if (options.sheets.empty()) return options.pattern.spacing_mm;
    std::map<const SheetEntry*, int> frames;
    for (const Place& place : places) {
        Fix fix;
        fix.status = Status::ok;
        fix.cell = place.cell;
        fix.section = place.section;
        if (const auto found = find_sheet(options.sheets, code, fix)) ++frames[found->entry];
    }
    if (frames.empty()) {
        throw Error(
            "no frame shows a sheet of the sheet file: give the sheet file of the printed page, or "
            "its --spacing");
    }
    const SheetEntry& sheet = *std::ranges::max_element(frames, {}, [](const auto& entry) {
                                   return entry.second;
                               })->first;
    return sheet.sheet.pattern.spacing_mm * std::sqrt(sheet.print_scale_x * sheet.print_scale_y);
}

}  // namespace dotpose::calibrate
