/// Reprints the page of a sheet.
#pragma once

#include <string>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/print.hpp"

namespace dotpose::cli {

/// Returns the options for reprinting the page of a sheet. If an earlier version of dotpose wrote
/// the entry without these options, returns the most likely options. Throws Error if the dots were
/// printed over a document, because the entry does not contain the document.
PrintOptions reprint_options(const SheetEntry& entry);

/// Reprints the page of a sheet, using the sheet's entry in the sheet file. Warns if the entry does
/// not contain the print options. Throws the same errors as `reprint_options` and `write_sheet`.
void reprint_sheet(const SheetEntry& entry, const std::string& out);

}  // namespace dotpose::cli
