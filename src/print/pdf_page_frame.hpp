/// Where the page that a reader sees lies in the coordinates of its content.
#pragma once

#include <string>

#include <qpdf/QPDFPageObjectHelper.hh>

#include "dotpose/print.hpp"

namespace dotpose::print {

/// The crop box, turned the way the page is shown.
struct PageFrame {
    Paper paper;  ///< size as shown
    std::string
        matrix;  ///< operand of `cm`: from points, from the bottom left as shown, to content
};

/// Follows /Rotate, /UserUnit and inherited boxes. Throws Error if the page has no area.
PageFrame page_frame(QPDFPageObjectHelper page);

}  // namespace dotpose::print
