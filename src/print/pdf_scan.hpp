/// What a page's content paints, before dots are laid over or under it.
#pragma once

#include <qpdf/QPDFPageObjectHelper.hh>

#include "pdf_limits.hpp"

namespace dotpose::print {

struct PageContent {
    bool paints_black = false;   ///< text or drawings that need black ink
    bool paints_images = false;  ///< images, whose colours are not looked at
    bool paints_areas = false;   ///< filled shapes, shadings or images: they cover what is below
    int unclosed_saves = 0;      ///< q without Q at the end
    int extra_restores = 0;      ///< Q without q before it
};

/// Follows forms too, and counts in `unpacked` what is read. Reads the page only. Throws Error if
/// content cannot be read to its end: a reader would not get as far as the dots.
PageContent scan_page(QPDFPageObjectHelper page, UnpackedBytes& unpacked);

}  // namespace dotpose::print
