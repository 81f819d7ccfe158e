/// Where the page that a reader sees lies in the coordinates of its content.
#pragma once

#include <string>

#include <qpdf/QPDFPageObjectHelper.hh>

#include "dotpose/tools/print.hpp"

namespace dotpose::print {

/// The crop box, turned the way the page is shown.
struct PageFrame {
    Paper paper;  ///< size as shown
    std::string
        matrix;  ///< operand of `cm`: from points, from the bottom left as shown, to content
};

/// Follows /Rotate, /UserUnit and inherited boxes. Throws Error if the page has no area
/// or is turned by other than quarter turns, which readers show in different ways.
PageFrame page_frame(QPDFPageObjectHelper page);

/// Writes a turn that is a real, such as 90.0, as an integer: some readers take it for none.
void write_turn_as_integer(QPDFPageObjectHelper page);

}  // namespace dotpose::print
