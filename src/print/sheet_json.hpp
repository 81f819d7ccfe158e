/// The text of a sheet file (docs/sheet-files.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/tools/sheet_file.hpp"

namespace dotpose::print {

/// `file` is what messages call the file. Throws Error; see `read_sheets`.
std::vector<SheetEntry> sheets_from_json(const std::string& text, const std::string& file);

/// Keys of `old_text`, a valid sheet file, that this version does not know are kept.
std::string json_from_sheets(const std::vector<SheetEntry>& sheets,
                             const std::optional<std::string>& old_text);

}  // namespace dotpose::print
