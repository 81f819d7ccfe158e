/// What a PDF page says about itself in its margins: text below the dots, rulers above and beside.
#pragma once

#include <string>

#include "dotpose/tools/print.hpp"

namespace dotpose::print {

/// Where a page stands in its document.
struct PageNumber {
    int number = 1;  ///< from 1
    int count = 1;
};

/// PDF content, in points from the bottom left corner of the page; needs Helvetica as /Label.
/// Leaves out what the margins have no room for, the command first, so that no label touches a dot.
std::string label_content(const Sheet& sheet, PageNumber page, const PrintOptions& options);

}  // namespace dotpose::print
