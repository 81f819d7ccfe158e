/// Printing: lays a part of the code plane out on a page and writes it as text, SVG,
/// PNG, TIFF or PDF.
///
///     dotpose::SheetOptions options;                      // A4, 5 mm margin, 0.508 mm spacing
///     options.origin = {.x = 1000, .y = 2000};
///     const dotpose::Sheet sheet = dotpose::make_sheet(options);
///     dotpose::write_sheet(sheet, "page.png");
///
/// Rows are written as they are made: memory grows with the width of the page, not with its area.
/// Functions throw BadArgument or Error (error.hpp); they share no state, so threads may write
/// different files at the same time.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Most pages of one document.
inline constexpr int kMaxPages = 10'000;
/// Largest accepted resolution of PNG, TIFF and PDF files.
inline constexpr double kMaxResolution_dpi = 19'200;

/// Size of a page; the default is A4, portrait.
struct Paper {
    double width_mm = 210;
    double height_mm = 297;
};

/// Size by name: A0 to A6, Letter, Legal, Tabloid (portrait, in any case of letters), or
/// WIDTHxHEIGHT in mm, for example "100x62.5".
/// Throws BadArgument for any other text, and for sizes outside (0, kMaxPage_mm].
Paper paper_by_name(std::string_view name);

/// The same page with its longer side across.
Paper landscape(Paper paper);

/// What `make_sheet` lays out.
struct SheetOptions {
    Pattern pattern;       ///< code, section and measures of the dots
    Cell origin;           ///< cell of the top left dot; choose another for each sheet
    Paper paper;           ///< the page; default A4 portrait
    double margin_mm = 5;  ///< kept free of ink on all sides; 0 for printers that reach the edge
};

/// Fills the page inside its margins with whole cells, from the top left.
///
/// The first intersection is the first one whose dot clears the margin and whose coordinates are an
/// odd multiple of half a 300 dpi printer pixel. With the default pattern every dot then covers
/// whole printer pixels at 300, 600 and 1200 dpi (paper section III-A.1, Fig. 11).
///
/// Throws BadArgument: see `validate`; also if the margins leave no room for kMinSheetCells columns
/// and rows, and if the region would run past the end of the code plane.
Sheet make_sheet(const SheetOptions& options);

/// `pages` sheets whose regions lie side by side, none sharing a cell with another: each begins to
/// the right of the one before; past the end of the plane a new line of regions begins below, at
/// `options.origin.x`.
///
/// Throws BadArgument: see `make_sheet`; also if `pages` is not 1 to kMaxPages.
std::vector<Sheet> make_sheets(const SheetOptions& options, int pages);

/// Checks that a printer of this resolution can show the pattern: the displacement is at least one
/// printer pixel and at least one white pixel parts any two dots. Throws BadArgument.
void validate_resolution(const Sheet& sheet, double dpi);

/// File formats.
enum class PrintFormat {
    text,  ///< the letters u, d, l, r; one line per row of the pattern (paper section III-A.1)
    svg,   ///< true size in mm, black round dots
    png,   ///< 1 bit per pixel
    tiff,  ///< 1 bit per pixel, CCITT group 4
    pdf,   ///< true size, black ink only (K), labels and rulers in the margins, several pages
};

/// Format by file ending: .txt .svg .png .tif .tiff .pdf, in any case. Throws BadArgument for
/// others.
PrintFormat print_format(const std::filesystem::path& path);

/// Told after each row of the pattern; return false to give up.
using Progress = std::function<bool(int rows_done, int rows)>;

/// What a dot is in a PDF.
enum class DotDrawing {
    automatic,  ///< `glyphs` where they are exact, else `strokes`
    glyphs,   ///< text in a font of four glyphs: small and fast, but renderers move every glyph to
              ///< a whole pixel, so spacing, displacement and dot must be whole pixels
    strokes,  ///< lines of no length with round ends: exact at any spacing
};

/// How `write_sheet` writes.
struct PrintOptions {
    /// Resolution of PNG, TIFF and PDF, in dots per inch. Use the printer's own. A PDF has no
    /// pixels, but this decides how its dots are drawn. Not used by text, SVG.
    double dpi = 600;
    DotDrawing drawing = DotDrawing::automatic;  ///< PDF only
    /// PDF only: name, page, region, spacing and a ruler in the margins, as far as there is room.
    bool labels = true;
    std::string name;     ///< PDF only: first of the labels, and the document's title
    std::string command;  ///< PDF only: label that says how to make the sheet again
    /// Called often, so it must be cheap. Default: none.
    Progress progress;
};

/// Writes the sheet in the format of the file's ending.
///
/// In PNG and TIFF the centre of every dot is rounded by itself to the nearest position the printer
/// has, so the error is at most half a printer pixel per axis and does not add up.
///
/// The file appears complete or not at all: it is written under a temporary name in the same
/// directory and renamed at the end. After any error, and when `progress` returned false, a file
/// that was there before is unchanged and nothing is left behind.
///
/// Throws BadArgument: `print_format`, `validate`, `validate_resolution`; DotDrawing::glyphs asked
/// for where lengths are no whole pixels. Throws Error: the file
/// cannot be created or written (with the system's reason), or `progress` returned false.
void write_sheet(const Sheet& sheet, const std::filesystem::path& path,
                 const PrintOptions& options = {});

/// The same for a document of several pages; more than one must be a PDF.
/// Throws as `write_sheet`, and BadArgument if there is no sheet or the format takes only one.
void write_sheets(std::span<const Sheet> sheets, const std::filesystem::path& path,
                  const PrintOptions& options = {});

/// A filled rectangle on a page, in sheet coordinates.
struct InkRectangle {
    double x_mm = 0;  ///< left edge
    double y_mm = 0;  ///< upper edge
    double width_mm = 0;
    double height_mm = 0;
};

/// A page with several regions of the code, and other print. Each sheet has the size of the page.
struct PrintPage {
    double width_mm = 0;
    double height_mm = 0;
    std::vector<Sheet> sheets;
    std::vector<InkRectangle> marks;
};

/// Rectangles that show a text: digits, '.', '/', '-', 'x', 'm' and spaces; others stay blank.
/// `x_mm`, `y_mm`: its upper left corner.
std::vector<InkRectangle> ink_text(std::string_view text, double x_mm, double y_mm,
                                   double height_mm);

/// Writes a page as `write_sheet` does, as PDF, SVG, PNG or TIFF; BadArgument for text. Where
/// regions overlap, both are printed. Holds the page at one bit per pixel in memory for PNG and
/// TIFF. A PDF has no labels but the marks.
void write_page(const PrintPage& page, const std::filesystem::path& path,
                const PrintOptions& options = {});

}  // namespace dotpose

#pragma GCC visibility pop
