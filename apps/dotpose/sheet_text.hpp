/// Describes the sheets in a sheet file as text that is safe to print on a terminal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

/// Returns the entry with the given name. Throws BadArgument if there is none. The error message
/// contains `file`, the path of the sheet file, and the names in the file.
const SheetEntry& named_sheet(const std::vector<SheetEntry>& sheets, const std::string& name,
                              const std::string& file);

/// Returns the code of the sheets, or none if the sheets have different codes. `file` is the path
/// of the sheet file. Throws Error if there are no sheets.
std::optional<CodeVariant> common_code(const std::string& file,
                                       const std::vector<SheetEntry>& sheets);

/// Describes the world pose of the page, in mm and degrees.
std::string world_text(const SheetEntry& entry);

/// Describes the consequences of removing a sheet.
std::string removal_text(const std::string& name);

/// Returns a table with one line for each sheet.
std::string list_text(const std::vector<SheetEntry>& sheets);

/// Returns all properties of a sheet, with one line per property.
std::string sheet_text(const SheetEntry& entry);

}  // namespace dotpose::cli
