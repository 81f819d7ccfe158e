/// Printing: lays out a part of the code plane on a page, and writes the page as text, SVG, PNG,
/// TIFF or PDF.
///
///     dotpose::SheetOptions options;                      // A4, 5 mm margin, 0.508 mm spacing
///     options.origin = {.x = 1000, .y = 2000};
///     const dotpose::Sheet sheet = dotpose::make_sheet(options);
///     dotpose::write_sheet(sheet, "page.png");
///
/// Pages are written row by row, so memory use grows with the width of the page, not with its area.
/// Functions throw BadArgument or Error (error.hpp). They share no state, so threads may write
/// different files at the same time.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Maximum number of pages in one document.
inline constexpr int kMaxPages = 10'000;
/// Maximum resolution of PNG, TIFF and PDF files.
inline constexpr double kMaxResolution_dpi = 19'200;

/// Size of a page. The default is A4, portrait.
struct Paper {
    double width_mm = 210;
    double height_mm = 297;
};

/// Returns the page size for a name (A0 to A6, Letter, Legal or Tabloid, in upper or lower case) or
/// for dimensions WIDTHxHEIGHT in mm, such as "100x62.5". Named sizes are in portrait orientation.
/// Throws BadArgument for any other text, and for sizes outside (0, kMaxPage_mm].
Paper paper_by_name(std::string_view name);

/// Returns the page in landscape orientation: its longer side is the width.
Paper landscape(Paper paper);

/// Options for `make_sheet`.
struct SheetOptions {
    Pattern pattern;  ///< code, section, and dimensions of the dots
    /// Cell of the top left dot. Each sheet should have its own cells.
    Cell origin;
    Paper paper;           ///< size of the page, by default A4 portrait
    double margin_mm = 5;  ///< unprinted margin on all sides, 0 for borderless printing
};

/// Lays out a sheet: fills the page inside its margins with whole cells, from the top left.
///
/// The first intersection is as close to the top left corner as two conditions permit: its dot must
/// be inside the margins, and its coordinates must be odd multiples of half a 300 dpi printer
/// pixel. With these coordinates, every dot of the default pattern covers whole printer pixels at
/// 300, 600 and 1200 dpi (paper, section III-A.1, figure 11).
///
/// Throws BadArgument if the options do not give a valid sheet (see `validate`), if the margins
/// leave less space than kMinSheetCells columns and rows, or if the region would extend past the
/// end of the code plane.
Sheet make_sheet(const SheetOptions& options);

/// Lays out `pages` sheets with adjacent regions that do not overlap. Regions are placed from left
/// to right. A region that would extend past the right edge of the plane starts a new row of
/// regions below, at column `options.origin.x`.
///
/// Throws BadArgument in the cases listed for `make_sheet`, and if `pages` is outside [1,
/// kMaxPages].
std::vector<Sheet> make_sheets(const SheetOptions& options, int pages);

/// Checks that a printer with this resolution can print the pattern. The resolution must be above 0
/// and at most kMaxResolution_dpi. The displacement must be at least one printer pixel, and there
/// must be at least one white pixel between any two dots. Throws BadArgument otherwise.
void validate_resolution(const Sheet& sheet, double dpi);

/// File formats of printed sheets.
enum class PrintFormat {
    text,  ///< the letters u, d, l, r, one line per row of the pattern (paper, section III-A.1)
    svg,   ///< true size in mm, black round dots
    png,   ///< 1 bit per pixel
    tiff,  ///< 1 bit per pixel, CCITT group 4
    pdf,   ///< true size, black ink only (K), labels and rulers in the margins, several pages
};

/// Returns the format for a file extension: .txt, .svg, .png, .tif, .tiff or .pdf, in upper or
/// lower case. Throws BadArgument for other extensions.
PrintFormat print_format(const std::filesystem::path& path);

/// Callback that reports the progress of an operation. It is called after each step, which is
/// usually a row of the pattern. `rows` is the total number of steps. If the callback returns
/// false, the operation is aborted with an Error.
using Progress = std::function<bool(int rows_done, int rows)>;

/// Methods of drawing dots in a PDF.
enum class DotDrawing {
    automatic,  ///< `glyphs` if this method is exact, otherwise `strokes`
    /// Text in a font of four glyphs: small and fast. Renderers round the position of every glyph
    /// to whole pixels. Spacing, displacement and dot diameter must therefore be integer multiples
    /// of the pixel size.
    glyphs,
    strokes,  ///< lines of length 0 with round caps: exact at any spacing
};

/// Options for `write_sheet`.
struct PrintOptions {
    /// Resolution of PNG and TIFF files, in dpi. It should be the resolution of the printer. A PDF
    /// has no pixels, but its resolution is checked with `validate_resolution`, and defines the
    /// pixel size for DotDrawing::glyphs. Not used for text and SVG.
    double dpi = 600;
    DotDrawing drawing = DotDrawing::automatic;  ///< PDF only: method of drawing dots
    /// PDF only: true to add labels (name, page, region and spacing) and rulers in the margins
    /// where they fit.
    bool labels = true;
    std::string name;     ///< PDF only: the first label, and the title of the document
    std::string command;  ///< PDF only: label with the command that reprints the sheet
    /// PDF only: one command for each page, in the order of the sheets. If not empty, these
    /// commands replace `command`.
    std::vector<std::string> page_commands;
    int first_page = 1;  ///< PDF only: page number of the first sheet, as shown in the labels
    /// PDF only: total number of pages, as shown in the labels. If 0, the labels show the number of
    /// sheets.
    int page_count = 0;
    /// Progress callback, none by default. It is called often, so it must be fast.
    Progress progress;
};

/// Writes the sheet in the format given by the file extension.
///
/// In PNG and TIFF, the centre of every dot is rounded to the nearest printer pixel. The error is
/// at most half a printer pixel per axis and does not accumulate.
///
/// The file is written completely or not at all: it is first written under a temporary name in the
/// same directory, and then renamed. After an error, and if `progress` returned false, an existing
/// file is unchanged and no temporary file remains.
///
/// Throws BadArgument in the same cases as `print_format`, `validate` and `validate_resolution`,
/// and for DotDrawing::glyphs if a length is not an integer multiple of the pixel size. Throws
/// Error if the file cannot be created or written, with the system's error message, or if
/// `progress` returned false.
void write_sheet(const Sheet& sheet, const std::filesystem::path& path,
                 const PrintOptions& options = {});

/// Variant of `write_sheet` for a document of several pages. More than one page requires a PDF.
/// Throws Error and BadArgument in the cases listed for `write_sheet`. Also throws BadArgument if
/// there is no sheet, or if there are several sheets and the format supports only one page.
void write_sheets(std::span<const Sheet> sheets, const std::filesystem::path& path,
                  const PrintOptions& options = {});

/// A filled rectangle on a page, in sheet coordinates.
struct InkRectangle {
    double x_mm = 0;  ///< left edge
    double y_mm = 0;  ///< upper edge
    double width_mm = 0;
    double height_mm = 0;
};

/// A page that can contain several regions of the code, and other marks. There must be at least one
/// sheet. Each sheet must have the width and height of the page.
struct PrintPage {
    double width_mm = 0;
    double height_mm = 0;
    std::vector<Sheet> sheets;
    std::vector<InkRectangle> marks;
};

/// Returns rectangles that form a line of text. `text` may contain digits, '.', '/', '-', 'x', 'm'
/// and spaces. Other characters are left blank. (`x_mm`, `y_mm`) is the upper left corner of the
/// text, and `height_mm` is the height of its characters.
std::vector<InkRectangle> ink_text(std::string_view text, double x_mm, double y_mm,
                                   double height_mm);

/// Writes a page as PDF, SVG, PNG or TIFF, in the same way as `write_sheet`. Throws BadArgument for
/// the text format, and for pages that contain no sheet or a sheet of another size. If regions
/// overlap, both are printed. For PNG and TIFF, the whole page is stored in memory with one bit per
/// pixel. A PDF contains the marks but no labels.
void write_page(const PrintPage& page, const std::filesystem::path& path,
                const PrintOptions& options = {});

}  // namespace dotpose

DOTPOSE_END_EXPORT
