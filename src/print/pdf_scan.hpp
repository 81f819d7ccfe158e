/// Finds out what a page paints, before dots are laid over or under it.
#pragma once

#include <string>

#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "pdf_limits.hpp"

namespace dotpose::print {

struct PageContent {
    bool paints_black = false;   ///< text or drawings that need black ink
    bool paints_images = false;  ///< images, whose colours are not examined
    bool paints_areas = false;   ///< filled shapes, shadings or images: they cover what is below
    int unclosed_saves = 0;      ///< q without Q at the end
    int extra_restores = 0;      ///< Q without q before it

    /// Return the operators that begin and end a graphics state of its own for the content.
    std::string before() const;
    std::string after() const;
};

/// Scans the content of a page and of the forms that it uses, without changing them, and counts the
/// bytes in `unpacked`. Throws Error if the content cannot be read to its end, because a viewer
/// would not show the dots after it.
PageContent scan_page(QPDFPageObjectHelper page, UnpackedBytes& unpacked);

/// Whether dotpose printed the document or laid dots over the page before.
bool has_dots(QPDF& pdf, QPDFPageObjectHelper page);

}  // namespace dotpose::print
