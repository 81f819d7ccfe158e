/// Prints the page of a sheet again.
#pragma once

#include <string>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

/// Writes the page of a sheet again, from its entry alone. Reports what an entry of an earlier
/// version leaves open. Throws Error if the dots were laid over a document, which the entry does
/// not contain, and as `write_sheet`.
void reprint_sheet(const SheetEntry& entry, const std::string& out);

}  // namespace dotpose::cli
