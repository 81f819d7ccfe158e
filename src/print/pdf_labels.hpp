/// The labels in the margins of a PDF page: text below the dots, rulers above and beside them.
#pragma once

#include <string>

#include "dotpose/tools/print.hpp"
#include "pdf_script_text.hpp"

namespace dotpose::print {

/// Number of a page in its document.
struct PageNumber {
    int number = 1;  ///< from 1
    int count = 1;
};

/// Returns the labels as PDF content, in points from the bottom left corner of the page; it needs
/// the font resource /Label, which is Helvetica. Labels for which the margins have no room are left
/// out, the command first, so that no label touches a dot. Lines with letters that Helvetica lacks
/// are drawn by `script`, whose forms the page needs too.
std::string label_content(const Sheet& sheet, PageNumber page, const PrintOptions& options,
                          ScriptText& script);

}  // namespace dotpose::print
