/// The dots of a sheet as PDF content.
///
/// Frame of the content: points (1/72 inch) from the bottom left corner of the page, x right, y up.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <vector>

#include <qpdf/QPDF.hh>
#include <qpdf/QPDFObjectHandle.hh>

#include "dotpose/tools/print.hpp"

namespace dotpose::print {

inline constexpr double kPointsPerMm = 72 / 25.4;

/// Rows written so far, over all pages. qpdf calls for the rows while it writes the file and puts
/// words of its own around an exception, so the first one is kept here.
struct RowCount {
    Progress progress;
    std::int64_t done = 0;
    std::int64_t total = 0;
    std::exception_ptr stopped;
};

/// Whether glyphs show the pattern exactly: spacing, displacement and dot are whole pixels.
bool is_whole_pixels(const Pattern& pattern, double dpi);

/// What `asked` means for this pattern: never automatic. Throws BadArgument for glyphs that would
/// not be exact.
DotDrawing resolve_drawing(DotDrawing asked, const Pattern& pattern, double dpi);

/// Makes content streams whose data is computed only while the file is written, a band of rows per
/// stream: qpdf holds one compressed stream at a time, so memory does not grow with the page.
class DotContent {
  public:
    /// `pdf` must outlive this; `rows` counts what all streams write.
    DotContent(QPDF& pdf, double dpi, DotDrawing asked, std::shared_ptr<RowCount> rows);

    /// The sheet as streams, each of which stands alone. Throws BadArgument: `resolve_drawing`.
    std::vector<QPDFObjectHandle> streams(const Sheet& sheet);

    /// Resource dictionary that these streams need; may be empty.
    QPDFObjectHandle resources(const Sheet& sheet);

    /// The same streams as forms with resources of their own.
    std::vector<QPDFObjectHandle> forms(const Sheet& sheet);

  private:
    QPDFObjectHandle font(const Pattern& pattern);

    QPDF& pdf_;
    double dpi_;
    DotDrawing asked_;
    std::shared_ptr<RowCount> rows_;
    Pattern font_pattern_;
    QPDFObjectHandle font_;
};

}  // namespace dotpose::print
