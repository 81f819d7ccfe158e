/// Reads and writes the text of a sheet file (docs/sheet-files.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::files {

/// Parses the text of a sheet file. `file` is the name of the file in error messages. Throws the
/// same errors as `read_sheets`.
std::vector<SheetEntry> sheets_from_json(const std::string& text, const std::string& file);

/// Returns the text of a sheet file. Preserves the unrecognised keys of `old_text`, which must be a
/// valid sheet file. `old_names` maps new names of renamed sheets to their names in `old_text`.
std::string json_from_sheets(const std::vector<SheetEntry>& sheets,
                             const std::optional<std::string>& old_text,
                             const std::map<std::string, std::string>& old_names = {});

}  // namespace dotpose::files
