/// Reprints the page of a sheet.
#pragma once

#include <string>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

/// Reprints the page of a sheet from its entry alone. If the entry was written by an earlier
/// version, reports the print options that it does not contain. Throws Error if the dots were
/// printed over a document, because the entry does not contain the document. Also throws like
/// `write_sheet`.
void reprint_sheet(const SheetEntry& entry, const std::string& out);

}  // namespace dotpose::cli
