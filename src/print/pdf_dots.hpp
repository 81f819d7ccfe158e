/// The dots of a sheet as PDF content.
///
/// The content uses points (1/72 inch) from the bottom left corner of the page, with x to the right
/// and y up.
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

/// Name of the creator in the metadata of documents that dotpose prints.
inline constexpr const char* kCreator = "dotpose";
/// Prefix of the names of the page resources that draw the dots.
inline constexpr const char* kDotsName = "/Dots";

/// Counts the rows of dots written on all pages, and reports the progress. qpdf requests the rows
/// while it writes the file. If `progress` throws an exception, qpdf replaces its message. The
/// first exception is therefore stored in `stopped`.
struct RowCount {
    Progress progress;
    std::int64_t done = 0;
    std::int64_t total = 0;
    std::exception_ptr stopped;
};

/// Returns true if spacing, displacement and dot diameter are integer multiples of a pixel. Only
/// then do glyphs draw the pattern exactly.
bool is_whole_pixels(const Pattern& pattern, double dpi);

/// Replaces `DotDrawing::automatic` with the best choice for this pattern. Throws BadArgument if
/// glyphs are requested but cannot draw the pattern exactly.
DotDrawing resolve_drawing(DotDrawing asked, const Pattern& pattern, double dpi);

/// Creates content streams with the dots of sheets, one stream per band of rows. The data of a
/// stream are computed only while the file is written, and only one compressed stream at a time is
/// in memory. The memory needed is therefore independent of the size of the page.
class DotContent {
  public:
    /// `pdf` must outlive this object. `rows` counts the rows written by all streams.
    DotContent(QPDF& pdf, double dpi, DotDrawing asked, std::shared_ptr<RowCount> rows);

    /// Returns the dots of the sheet as independent content streams. Throws the same errors as
    /// `resolve_drawing`.
    std::vector<QPDFObjectHandle> streams(const Sheet& sheet);

    /// Returns the resource dictionary of the content streams. It may be empty.
    QPDFObjectHandle resources(const Sheet& sheet);

    /// Returns the content streams as form XObjects with their own resources.
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
