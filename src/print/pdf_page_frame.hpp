/// Converts between the displayed page and the coordinates of its content.
#pragma once

#include <string>

#include <qpdf/QPDFPageObjectHelper.hh>

#include "dotpose/tools/print.hpp"

namespace dotpose::print {

/// Size and position of the displayed part of a page. Viewers display the crop box.
struct PageFrame {
    Paper paper;  ///< displayed size
    /// Intersection of the crop box and the media box, in units of the content.
    QPDFObjectHandle::Rectangle box;
    /// Operands of `cm` that convert points from the bottom left corner of the displayed page to
    /// coordinates of the content.
    std::string matrix;
};

/// Computes the frame from /Rotate, /UserUnit and the boxes, which may be inherited. Throws Error
/// if the area of the page is 0. Also throws Error if the rotation is not a multiple of 90 degrees,
/// because viewers differ in how they display such pages.
PageFrame page_frame(QPDFPageObjectHelper page);

/// Replaces a /Rotate that is a real number, such as 90.0, with an integer, because some viewers
/// ignore real numbers.
void write_turn_as_integer(QPDFPageObjectHelper page);

}  // namespace dotpose::print
