/// Overlay: adds the pattern above or below the page content of an existing PDF.
///
///     dotpose::OverlayOptions options;
///     options.origin = {.x = 5000, .y = 0};
///     const dotpose::OverlayReport report = dotpose::overlay_pdf("in.pdf", "out.pdf", options);
///
/// Pages keep their content and features, such as text, links, forms, outlines, page boxes and
/// rotation. Each page with dots has its own region of the code plane. Copies of a page also have
/// different regions. The functions share no state.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/tools/print.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// One page with dots. The coordinates of its sheet are relative to the top left corner of the
/// displayed page or, if there are cards, of the card.
struct OverlaidPage {
    /// Number of the page, from 1, counted over all copies: the pages of the second copy follow the
    /// pages of the first copy.
    int number = 0;
    Sheet sheet;
    int document_page = 0;  ///< number of the page in the document, from 1
};

/// Options for the dots, and for the pages that contain dots.
struct OverlayOptions {
    Pattern pattern;  ///< code, section, and dimensions of the dots
    /// First cell of the first page. The first cells of the following pages are chosen as in
    /// `make_sheets`.
    Cell origin;
    double margin_mm = 5;  ///< margin without dots inside the visible page (its crop box)
    double dpi = 600;      ///< resolution of the printer (see PrintOptions)
    DotDrawing drawing = DotDrawing::automatic;
    /// Numbers of the pages to which dots are added, from 1, for example "1-3,7". "z" is the last
    /// page. If empty, dots are added to all pages.
    std::string pages;
    int copies = 1;  ///< number of copies of the document, each with its own cells
    /// Paper on which several pages with dots are printed side by side as cards, with cut marks.
    /// All pages with dots must have the same size. Cards have no links or form fields, and pages
    /// without dots are omitted. If not set, each page of the document remains a separate page.
    std::optional<Paper> card_paper;
    /// True to draw the dots below the content of the page instead of above it.
    bool under = false;
    /// Password of an encrypted input file. The output file is then also encrypted.
    std::string password;
    /// True to replace black ink with cyan, magenta and yellow. Infrared cameras see black ink, but
    /// not the other inks.
    bool black_to_cmy = false;
    double lighten = 0;  ///< fraction of the ink that is removed from the document, in [0, 1)
    /// Maximum size of the uncompressed content of one page, in megabytes. The limit for all pages
    /// together is eight times as large. Processing a page needs a few times this amount of memory.
    /// Increase the limit for pages with very detailed drawings, such as large maps.
    int max_content_mb = 64;
    Progress progress;
    /// Called once, before anything is written, with all pages to which dots are added. The
    /// function may change each `sheet.origin`, for example to a free region of a SheetFile. An
    /// exception cancels the overlay.
    std::function<void(std::span<OverlaidPage>)> place;
};

/// The result of an overlay.
struct OverlayReport {
    std::vector<OverlaidPage> pages;
    /// Messages for the user about content that may hide dots or was not converted.
    std::vector<std::string> warnings;
    int card_pages = 0;  ///< number of pages with cards, or 0 if there are no cards
};

/// Adds dots to the document `in`, and writes the result to `out`. Writes `out` atomically.
///
/// `black_to_cmy` and `lighten` change colours only on pages with dots. These options change the
/// colours of text, drawings, forms, fonts and annotation appearances, and of images if their
/// colour space permits. The report lists content that was not changed.
///
/// Throws BadArgument in these cases:
/// - The pattern, margin, page range or number of copies is invalid.
/// - Cards differ in size or are larger than their paper.
/// - A page is too small, or its region would extend past the end of the code plane.
/// - `out` is `in`.
///
/// Throws Error in these cases:
/// - `in` cannot be read, is damaged, needs another password, is nested too deeply or exceeds the
///   limit on uncompressed content.
/// - `out` cannot be written.
/// - `progress` returned false.
OverlayReport overlay_pdf(const std::filesystem::path& in, const std::filesystem::path& out,
                          const OverlayOptions& options = {});

}  // namespace dotpose

DOTPOSE_END_EXPORT
