/// Makes the PDF of a sheet in memory.
#pragma once

#include <functional>
#include <string>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

/// Throws Error if the page has more than 8 million dots, because writing its PDF would take
/// minutes.
void require_printable(const Sheet& sheet);

/// Returns the PDF of the page of a sheet, as `dotpose sheets reprint` writes it. Calls `goes_on`
/// often, and throws Error if it returns false. Also throws like `reprint_options` and
/// `write_sheet`.
std::string pdf_of(const SheetEntry& entry, const std::function<bool()>& goes_on);

}  // namespace dotpose::cli
