/// Pages of cards: several small pages side by side on a larger one, to be cut apart.
#pragma once

#include <string>

#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "dotpose/tools/print.hpp"

namespace dotpose::print {

/// A grid of cards in the middle of a page. Cards touch each other; the margin around them has
/// room for cut marks.
struct CardGrid {
    Paper paper;  ///< turned if more cards fit that way
    Paper card;
    int columns = 0;
    int rows = 0;
    double left_mm = 0;  ///< left edge of the first card
    double top_mm = 0;

    int cards() const { return columns * rows; }
};

/// Lays out as many cards as fit. Throws BadArgument if none does.
CardGrid card_grid(Paper paper, Paper card);

/// Returns the sheet of a card in the frame of the page. `slot` counts the cards of a page from 0,
/// row by row. The card is moved by less than a pixel at 300 dpi, so that its dots are where the
/// printer has pixels, as on a page of their own.
Sheet on_page(const CardGrid& grid, int slot, Sheet card);

/// Returns the cut marks as PDF content, in points from the bottom left corner of the page.
std::string cut_marks(const CardGrid& grid);

/// Returns a page as a form object, as it is shown.
QPDFObjectHandle card_form(QPDFPageObjectHelper page);

/// Returns the content that draws such a form as a card. `page` is the page of cards, which has it
/// as `name`.
std::string place_card(QPDFPageObjectHelper page, const CardGrid& grid, int slot,
                       const QPDFObjectHandle& form, const std::string& name);

/// Adds an empty page to a document.
QPDFPageObjectHelper add_card_page(QPDF& pdf, const CardGrid& grid);

/// Removes all pages of a document, and what refers to them: outlines, destinations, form fields.
void remove_pages(QPDF& pdf);

}  // namespace dotpose::print
