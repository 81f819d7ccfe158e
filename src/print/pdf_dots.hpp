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

/// The program that a document names as its creator, if dotpose printed it.
inline constexpr const char* kCreator = "dotpose";
/// Beginning of the names under which the resources of a page have its dots.
inline constexpr const char* kDotsName = "/Dots";

/// Counts the rows that have been written, over all pages, and keeps the first exception: qpdf asks
/// for the rows while it writes the file, and would replace the exception's message by its own.
struct RowCount {
    Progress progress;
    std::int64_t done = 0;
    std::int64_t total = 0;
    std::exception_ptr stopped;
};

/// Whether glyphs show the pattern exactly: spacing, displacement and dot are whole pixels.
bool is_whole_pixels(const Pattern& pattern, double dpi);

/// Replaces `DotDrawing::automatic` by the best choice for this pattern. Throws BadArgument if
/// glyphs were asked for and would not be exact.
DotDrawing resolve_drawing(DotDrawing asked, const Pattern& pattern, double dpi);

/// Makes content streams whose data is computed only while the file is written, a band of rows per
/// stream: qpdf holds one compressed stream at a time, so memory does not grow with the page.
class DotContent {
  public:
    /// `pdf` must outlive this object; `rows` counts the rows that all streams write.
    DotContent(QPDF& pdf, double dpi, DotDrawing asked, std::shared_ptr<RowCount> rows);

    /// Returns the sheet as content streams that can be drawn independently of each other. Throws
    /// BadArgument like `resolve_drawing`.
    std::vector<QPDFObjectHandle> streams(const Sheet& sheet);

    /// Returns the resource dictionary that these streams need; it may be empty.
    QPDFObjectHandle resources(const Sheet& sheet);

    /// Returns the streams of `streams` as form objects with their own resources.
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
