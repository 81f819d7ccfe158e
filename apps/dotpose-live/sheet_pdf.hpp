/// Makes the PDF of a sheet in memory.
#pragma once

#include <functional>
#include <string>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

/// Throws Error if the page has too many dots. Its PDF would take minutes to write.
void require_printable(const Sheet& sheet);

/// Returns the PDF of the page of a sheet, which `dotpose sheets reprint` would write. `goes_on` is
/// called often; returning false stops the work with an Error. Throws like `reprint_options` and
/// `write_sheet`.
std::string pdf_of(const SheetEntry& entry, const std::function<bool()>& goes_on);

}  // namespace dotpose::cli
