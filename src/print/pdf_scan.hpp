/// Finds out what a page paints, before dots are laid over or under it.
#pragma once

#include <qpdf/QPDFPageObjectHelper.hh>

#include "pdf_limits.hpp"

namespace dotpose::print {

struct PageContent {
    bool paints_black = false;   ///< text or drawings that need black ink
    bool paints_images = false;  ///< images, whose colours are not examined
    bool paints_areas = false;   ///< filled shapes, shadings or images: they cover what is below
    int unclosed_saves = 0;      ///< q without Q at the end
    int extra_restores = 0;      ///< Q without q before it
};

/// Scans the content of a page and of the forms that it uses, without changing them, and counts the
/// bytes in `unpacked`. Throws Error if the content cannot be read to its end, because a viewer
/// would not show the dots after it.
PageContent scan_page(QPDFPageObjectHelper page, UnpackedBytes& unpacked);

}  // namespace dotpose::print
