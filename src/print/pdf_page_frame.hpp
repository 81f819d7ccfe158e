/// Relation between the displayed page and the coordinates of its content.
#pragma once

#include <string>

#include <qpdf/QPDFPageObjectHelper.hh>

#include "dotpose/tools/print.hpp"

namespace dotpose::print {

/// Crop box of a page, in the displayed orientation.
struct PageFrame {
    Paper paper;  ///< displayed size
    /// Crop box within the media box, in units of the content.
    QPDFObjectHandle::Rectangle box;
    /// Operands of the operator `cm` that converts points from the bottom left corner of the
    /// displayed page to the coordinates of the content.
    std::string matrix;
};

/// Computes the frame from /Rotate, /UserUnit and the boxes. These entries may be inherited. Throws
/// Error if the area of the page is 0, or if the rotation of the page is not a multiple of 90
/// degrees. Viewers show other rotations in different ways.
PageFrame page_frame(QPDFPageObjectHelper page);

/// Replaces a /Rotate that is a real number, such as 90.0, by an integer, because some viewers
/// ignore a real number.
void write_turn_as_integer(QPDFPageObjectHelper page);

}  // namespace dotpose::print
