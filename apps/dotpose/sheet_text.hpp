/// Describes the sheets of a sheet file in words, safe to show on a terminal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

/// Returns the entry of this name. Throws BadArgument that lists the names in `file`, whose sheets
/// these are, if there is none.
const SheetEntry& named_sheet(const std::vector<SheetEntry>& sheets, const std::string& name,
                              const std::string& file);

/// Returns the code variant of all sheets, or none if they differ. Throws Error if `file`, whose
/// sheets these are, has none.
std::optional<CodeVariant> common_code(const std::string& file,
                                       const std::vector<SheetEntry>& sheets);

/// Returns where the page lies in the world, in mm and degrees.
std::string world_text(const SheetEntry& entry);

/// Returns a table with a line for each sheet.
std::string list_text(const std::vector<SheetEntry>& sheets);

/// Returns all that is known of a sheet, one line for each property.
std::string sheet_text(const SheetEntry& entry);

}  // namespace dotpose::cli
