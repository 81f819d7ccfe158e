/// Describes the sheets of a sheet file as text that is safe to print on a terminal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

/// Returns the entry with this name. `file` is the path of the sheet file. Throws BadArgument,
/// which lists the names in the file, if there is no such entry.
const SheetEntry& named_sheet(const std::vector<SheetEntry>& sheets, const std::string& name,
                              const std::string& file);

/// Returns the code of all sheets, or none if they have different codes. `file` is the path of the
/// sheet file. Throws Error if there are no sheets.
std::optional<CodeVariant> common_code(const std::string& file,
                                       const std::vector<SheetEntry>& sheets);

/// Returns the pose of the page in the world, in mm and degrees.
std::string world_text(const SheetEntry& entry);

/// Returns a table with one line for each sheet.
std::string list_text(const std::vector<SheetEntry>& sheets);

/// Returns all properties of a sheet, one per line.
std::string sheet_text(const SheetEntry& entry);

}  // namespace dotpose::cli
