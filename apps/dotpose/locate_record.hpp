/// The results for one image, which become one output line of `dotpose locate`.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/tools/follower.hpp"
#include "fields.hpp"
#include "pose_fields.hpp"

namespace dotpose::cli {

struct Record {
    std::string file;
    Fix fix;
    CodeReading reading;         ///< code and alternative places; `fix` is at the image centre
    bool code_is_given = false;  ///< true if the user or the sheets determine the code
    double spacing_mm = 0;       ///< NaN if unknown, in which case there are no fields in mm
    /// Spacing computed from the fix and the camera file; see Located.
    double camera_spacing_mm = std::numeric_limits<double>::quiet_NaN();
    /// Velocity of the camera during the readout of a rolling shutter; see Located.
    std::optional<ReadoutVelocity> velocity;
    bool has_sheets = false;          ///< true if the record has the fields of a sheet file
    std::optional<SheetPlace> place;  ///< place of the fix; none if it is on no sheet
    int min_side_px() const { return has_sheets ? kMinKnownFrameSide_px : kMinFrameSide_px; }
    double elapsed_us = 0;  ///< time taken to locate the image; NaN if not measured
    std::string advice;     ///< advice if there is no fix; may be empty
    int width_px = 0;
    int height_px = 0;
    int min_dots = 0;          ///< minimum number of dots for an attempt to locate
    int max_p_wrong_log2 = 0;  ///< positions are rejected if log2 of p_wrong exceeds this limit
};

/// Returns the record of an image that was just located, without file name, time and advice.
Record record_of(const Located& located, const Follower& follower);

/// Number of kinds of warnings.
inline constexpr std::size_t kWarnings = 3;
/// Returns the warnings of a frame; an empty text means no warning. In order: the user gave a code,
/// but another code explains the frame; the place is on no sheet of the sheet file; the spacing
/// that the camera file implies differs from the spacing of the sheet.
std::array<std::string, kWarnings> warnings(const Record& record);

/// Explains why there is no fix, with the relevant numbers. Empty if there is a fix.
std::string reason(const Record& record);

/// Returns the fields in the order of the output.
std::vector<Field> fields(const Record& record, Units units);

/// Selection of CSV columns.
enum class Columns {
    brief,  ///< pose with standard deviations and p_wrong; with a sheet file, the poses on the
            ///< sheet and in the world
    all,
};

/// Returns the fields that are columns, in order.
std::vector<Field> columns_of(std::vector<Field> fields, Columns columns);

/// Returns the CSV header of a run with or without sheets, with a line break.
std::string csv_header(bool has_sheets, Units units, Columns columns);

/// Returns one line of text: file, sheet, x, y and angle, each with its standard deviation, and the
/// place in the world. Without a fix, the line explains why.
std::string text_line(const Record& record, Units units);

}  // namespace dotpose::cli
