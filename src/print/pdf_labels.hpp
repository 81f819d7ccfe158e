/// Labels in the margins of a PDF page: text below the dots, and rulers above and to the left of
/// them.
#pragma once

#include <string>

#include "dotpose/tools/print.hpp"
#include "pdf_script_text.hpp"

namespace dotpose::print {

struct PageNumber {
    int number = 1;  ///< counted from 1
    int count = 1;
};

/// Returns the labels as PDF content, in points from the bottom left corner of the page. The page
/// must define Helvetica as the font resource /Label. Lines of text with letters that Helvetica
/// lacks are drawn by the forms of `script`. The page resources must also contain these forms.
/// Labels that do not fit in the margins are omitted, so no label touches a dot. The command line
/// is the first to be omitted.
std::string label_content(const Sheet& sheet, PageNumber page, const PrintOptions& options,
                          ScriptText& script);

}  // namespace dotpose::print
