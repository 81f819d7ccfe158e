/// Prints the page of a sheet again.
#pragma once

#include <string>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

/// Prints the page of a sheet again from its entry alone. Reports the print options that are
/// missing in an entry of an earlier version. Throws Error if the dots were printed over a
/// document, which the entry does not contain. Also throws like `write_sheet`.
void reprint_sheet(const SheetEntry& entry, const std::string& out);

}  // namespace dotpose::cli
