/// Labels in the margins of a PDF page: text below the dots, and rulers above and to the left of
/// them.
#pragma once

#include <string>

#include "dotpose/tools/print.hpp"
#include "pdf_script_text.hpp"

namespace dotpose::print {

struct PageNumber {
    int number = 1;  ///< from 1
    int count = 1;
};

/// Returns the labels as PDF content, in points from the bottom left corner of the page. The page
/// must have Helvetica as font resource /Label. Its resources must also contain the forms of
/// `script`, which draws lines with letters that Helvetica lacks. Labels that do not fit into the
/// margins are omitted, starting with the command, so no label touches a dot.
std::string label_content(const Sheet& sheet, PageNumber page, const PrintOptions& options,
                          ScriptText& script);

}  // namespace dotpose::print
