/// Describes the sheets of a sheet file in text that can be printed safely on a terminal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

/// Returns the entry with this name. `file` is the path of the sheet file. If there is no such
/// entry, throws BadArgument with a list of the names in the file.
const SheetEntry& named_sheet(const std::vector<SheetEntry>& sheets, const std::string& name,
                              const std::string& file);

/// Returns the common code of all sheets, or none if their codes differ. `file` is the path of the
/// sheet file. Throws Error if there are no sheets.
std::optional<CodeVariant> common_code(const std::string& file,
                                       const std::vector<SheetEntry>& sheets);

/// Returns the pose of the page in the world as text, in mm and degrees.
std::string world_text(const SheetEntry& entry);

/// Returns a text for the user about the consequences of removing a sheet.
std::string removal_text(const std::string& name);

/// Returns a table with one line for each sheet.
std::string list_text(const std::vector<SheetEntry>& sheets);

/// Returns all properties of a sheet, one per line.
std::string sheet_text(const SheetEntry& entry);

}  // namespace dotpose::cli
