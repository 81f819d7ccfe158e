/// Relation between the page as it is shown and the coordinates of its content.
#pragma once

#include <string>

#include <qpdf/QPDFPageObjectHelper.hh>

#include "dotpose/tools/print.hpp"

namespace dotpose::print {

/// The crop box of a page, turned as it is shown.
struct PageFrame {
    Paper paper;                      ///< size as shown
    QPDFObjectHandle::Rectangle box;  ///< crop box in the media box, in units of the content
    std::string matrix;  ///< operands of `cm`: from points, counted from the bottom left as shown,
                         ///< to content
};

/// Computes the frame from /Rotate, /UserUnit and the boxes, which may be inherited. Throws Error
/// if the page has no area, or if it is turned by an angle that is not a multiple of 90 degrees,
/// which viewers show in different ways.
PageFrame page_frame(QPDFPageObjectHelper page);

/// Replaces a /Rotate that is a real number, such as 90.0, by an integer: some viewers ignore a
/// real.
void write_turn_as_integer(QPDFPageObjectHelper page);

}  // namespace dotpose::print
