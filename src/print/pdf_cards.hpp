/// Pages of cards: a grid of small pages on a larger page that is cut apart after printing.
#pragma once

#include <string>

#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "dotpose/tools/print.hpp"

namespace dotpose::print {

/// Grid of cards, centred on a page. Adjacent cards touch. The margin around the grid leaves room
/// for cut marks.
struct CardGrid {
    Paper paper;  ///< rotated by 90 degrees if more cards fit that way
    Paper card;
    int columns = 0;
    int rows = 0;
    double left_mm = 0;  ///< left edge of the first card
    double top_mm = 0;

    int cards() const { return columns * rows; }
};

/// Lays out as many cards as fit on the paper. Throws BadArgument if no card fits.
CardGrid card_grid(Paper paper, Paper card);

/// Converts the sheet of a card to page coordinates. `slot` is the index of the card on the page,
/// counted row by row. Shifts the card by less than a pixel at 300 dpi, to align its dots with the
/// printer pixels. The dots of a card on a separate page are aligned in the same way.
Sheet on_page(const CardGrid& grid, int slot, Sheet card);

/// Returns the cut marks as PDF content, in points from the bottom left corner of the page.
std::string cut_marks(const CardGrid& grid);

/// Returns the displayed part of a page as a form XObject.
QPDFObjectHandle card_form(QPDFPageObjectHelper page);

/// Returns the content that draws a card on `page`. `form` is a result of `card_form`, and the
/// resources of `page` contain it under `name`.
std::string place_card(QPDFPageObjectHelper page, const CardGrid& grid, int slot,
                       const QPDFObjectHandle& form, const std::string& name);

/// Adds an empty page with the size of the paper to a document.
QPDFPageObjectHelper add_card_page(QPDF& pdf, const CardGrid& grid);

/// Removes all pages of a document, and everything that refers to pages, such as outlines,
/// destinations and form fields.
void remove_pages(QPDF& pdf);

}  // namespace dotpose::print
