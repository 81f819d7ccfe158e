/// Formats the results of `dotpose check-print` as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/check_print.hpp"

namespace dotpose::cli {

/// The checked image and the sheets that it was compared with.
struct CheckedScan {
    std::string file;
    int page = 1;   ///< number of the checked page
    int pages = 1;  ///< number of pages in the file
    int width_px = 0;
    int height_px = 0;
    std::vector<SheetEntry> sheets;  ///< in the order of CheckPrintOptions::sheets
};

std::string text_report(const CheckedScan& scan, const PrintCheck& check);

/// Returns the results as one JSON object.
std::string json_report(const CheckedScan& scan, const PrintCheck& check);

}  // namespace dotpose::cli
