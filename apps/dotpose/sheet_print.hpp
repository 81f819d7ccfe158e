/// New pages of a sheet file, with the settings of `dotpose print`.
#pragma once

#include <string>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/print.hpp"

namespace dotpose::cli {

/// Returns the default margin in mm. The labels and rulers of a PDF need a margin wider than the
/// unprintable margin of a printer.
double default_margin_mm(PrintFormat format, const Paper& paper);

/// Returns a file name without special characters for the PDF of a sheet.
std::string pdf_name(const std::string& sheet);

/// A page to be printed as PDF.
struct NewPage {
    std::string name;           ///< name of the sheet
    std::string paper = "A4";   ///< name or size of the paper, as for `paper_by_name`
    bool is_landscape = false;  ///< true if the longer side is horizontal
    double spacing_mm = kDefaultSpacing_mm;
};

/// Adds a page to a sheet file, in a free region and with its print settings. Returns the new
/// entry. Throws BadArgument like `make_sheet` and `SheetFile::allocate`.
SheetEntry enter_page(SheetFile& file, const NewPage& page);

}  // namespace dotpose::cli
