/// Overlay: lays the pattern over, or under, the pages of an existing PDF.
///
///     dotpose::OverlayOptions options;
///     options.origin = {.x = 5000, .y = 0};
///     const dotpose::OverlayReport report = dotpose::overlay_pdf("in.pdf", "out.pdf", options);
///
/// Pages keep their content and functions: text, links, forms, outlines, boxes, rotation. Each page
/// with dots has its own region of the code plane, in each copy. Functions share no state.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dotpose/tools/print.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// One page with dots. The frame of its sheet begins at the top left corner of the displayed page.
struct OverlaidPage {
    /// Number of the page among those of all copies, from 1. The pages of the second copy follow
    /// those of the first.
    int number = 0;
    Sheet sheet;
    int document_page = 0;  ///< number of the page in the document, from 1
};

/// The dots, and the pages that get them.
struct OverlayOptions {
    Pattern pattern;       ///< code, section and measures of the dots
    Cell origin;           ///< first cell of the first page; the others follow as in `make_sheets`
    double margin_mm = 5;  ///< margin without dots inside the visible page (its crop box)
    double dpi = 600;      ///< as in PrintOptions
    DotDrawing drawing = DotDrawing::automatic;
    /// Pages that get dots, from 1, for example "1-3,7"; "z" is the last page. Empty: all.
    std::string pages;
    int copies = 1;  ///< copies of the document, each with its own cells
    /// Paper on which several pages with dots are printed side by side, with cut marks. The pages
    /// become cards: the sheet of each begins at the corner of its card. Cards have no links and
    /// form fields, and pages without dots are omitted. None: each page stays a page.
    std::optional<Paper> card_paper;
    bool under = false;    ///< whether dots are below the page's content instead of above
    std::string password;  ///< password of an encrypted file, which stays encrypted
    bool black_to_cmy =
        false;  ///< replaces black ink, which is visible in infrared light, by the other inks
    double lighten = 0;  ///< fraction of the ink that is removed from the document, 0 to below 1
    /// Maximum unpacked content of one page, in megabytes; all pages together may have eight times
    /// as much. A page takes a few times this size in memory. Increase it for large maps.
    int max_content_mb = 64;
    Progress progress;
    /// Called once with all pages that get dots, before anything is written. It may change each
    /// `sheet.origin`, for example to a free region of a SheetFile. An exception ends the work.
    std::function<void(std::span<OverlaidPage>)> place;
};

/// The result of an overlay.
struct OverlayReport {
    std::vector<OverlaidPage> pages;
    std::vector<std::string>
        warnings;        ///< for the user: content that may hide dots or was not converted
    int card_pages = 0;  ///< number of pages of cards; 0 without them
};

/// Writes `in` with dots to `out`, which appears complete or not at all.
///
/// `black_to_cmy` and `lighten` change colours only on pages with dots: of text, drawings, forms,
/// fonts and appearances, and of images if their colour space permits. The report lists what is not
/// changed.
///
/// Throws BadArgument: bad pattern, margin, page range or number of copies; cards of different
/// sizes, or larger than their paper; a page that is too small or whose region would run past the
/// end of the code plane; `out` is `in`. Throws Error: `in` cannot be read, is damaged, needs
/// another password, is nested too deeply or unpacks to too much; `out` cannot be written;
/// `progress` returned false.
OverlayReport overlay_pdf(const std::filesystem::path& in, const std::filesystem::path& out,
                          const OverlayOptions& options = {});

}  // namespace dotpose

#pragma GCC visibility pop
