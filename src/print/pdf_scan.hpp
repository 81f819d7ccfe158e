/// Determines what a page paints, before dots are drawn over or under its content.
#pragma once

#include <string>

#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "pdf_limits.hpp"

namespace dotpose::print {

struct PageContent {
    bool paints_black = false;   ///< true if the page has text or drawings that need black ink
    bool paints_images = false;  ///< true if the page has images, whose colours are not examined
    /// True if the page has filled shapes, shadings or images, which would hide dots drawn under
    /// them.
    bool paints_areas = false;
    int unclosed_saves = 0;  ///< number of operators q (save) without a matching Q
    int extra_restores = 0;  ///< number of operators Q (restore) without a preceding q

    /// Return the operators to write before and after the content to prevent it from changing the
    /// graphics state of other content.
    std::string before() const;
    std::string after() const;
};

/// Scans the content of a page and of its forms, and adds their unpacked size to `unpacked`. Throws
/// Error if the content cannot be read completely, because viewers stop at damaged content and
/// would not show dots added after it.
PageContent scan_page(QPDFPageObjectHelper page, UnpackedBytes& unpacked);

/// Returns true if dotpose printed the document, or has already added dots to the page.
bool has_dots(QPDF& pdf, QPDFPageObjectHelper page);

}  // namespace dotpose::print
