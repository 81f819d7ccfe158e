/// Adds new pages to a sheet file, with the settings of `dotpose print`.
#pragma once

#include <string>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/print.hpp"

namespace dotpose::cli {

/// Returns the default margin in mm. The margin of a PDF contains labels and rulers. It is
/// therefore wider than the margin in other formats, except on small pages.
double default_margin_mm(PrintFormat format, const Paper& paper);

/// Returns a file name for the PDF of a sheet. The name contains no special characters.
std::string pdf_name(const std::string& sheet);

/// A page to be printed as a PDF.
struct NewPage {
    std::string name;           ///< name of the sheet
    std::string paper = "A4";   ///< name or size of the paper, as in `paper_by_name`
    bool is_landscape = false;  ///< true if the longer side is horizontal
    double spacing_mm = kDefaultSpacing_mm;
};

/// Adds a page and its print settings to a sheet file. Places the page in a free region. Returns
/// the new entry. Throws BadArgument in the same cases as `make_sheet` and `SheetFile::allocate`.
SheetEntry enter_page(SheetFile& file, const NewPage& page);

}  // namespace dotpose::cli
