/// Creates the PDF of a sheet in memory.
#pragma once

#include <functional>
#include <string>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

/// Throws Error if the page has more than 8 million dots. Writing such a PDF would take minutes.
void require_printable(const Sheet& sheet);

/// Returns the PDF that `dotpose sheets reprint` would write for a sheet. Calls `goes_on`
/// frequently, and throws Error when it returns false. Also throws the same errors as
/// `reprint_options` and `write_sheet`.
std::string pdf_of(const SheetEntry& entry, const std::function<bool()>& goes_on);

}  // namespace dotpose::cli
