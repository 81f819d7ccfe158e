/// The results for one image, which are one output line of `dotpose locate`.
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
    CodeReading reading;  ///< code variant and other places; its fix is that of the image centre
    bool code_is_given = false;  ///< whether the user or the sheets determine the code variant
    double spacing_mm = 0;       ///< NaN if it is not known; then there are no fields in mm
    double camera_spacing_mm = std::numeric_limits<double>::quiet_NaN();  ///< as in Located
    bool has_sheets = false;  ///< whether there is a sheet file, so that its fields are output
    std::optional<SheetPlace> place;  ///< the place on a sheet
    double elapsed_us = 0;            ///< time that `dotpose::locate` took
    std::string advice;               ///< what would help, if there is no fix; may be empty
    int width_px = 0;
    int height_px = 0;
    int min_dots = 0;          ///< fewest dots with which locating is tried
    int max_p_wrong_log2 = 0;  ///< positions that may be wrong with more than 2^this are refused
};

/// The record of an image that was just located; file name, time and advice are left open.
Record record_of(const Located& located, const Follower& follower);

/// Number of warnings that a frame may have.
inline constexpr std::size_t kWarnings = 3;
/// Returns the warnings of a frame, each empty if there is no reason for it: the user gave a
/// code variant and another one explains the frame; the place is on no sheet of the sheet file; the
/// camera file measures another spacing.
std::array<std::string, kWarnings> warnings(const Record& record);

/// Explains why there is no fix, with the relevant numbers; empty if there is one.
std::string reason(const Record& record);

/// Returns the fields in the order of the output.
std::vector<Field> fields(const Record& record, Units units);

/// The columns of CSV.
enum class Columns {
    brief,  ///< pose with standard deviations and p_wrong; with sheets on the sheet and in the
            ///< world
    all,
};

/// Returns the fields that are columns, in their order.
std::vector<Field> columns_of(std::vector<Field> fields, Columns columns);

/// Returns the header line of a run with or without sheets, with its line break.
std::string csv_header(bool has_sheets, Units units, Columns columns);

/// Returns one line to read: file, sheet, x, y and angle, each with its standard deviation, and the
/// place in the world; or why there is no fix.
std::string text_line(const Record& record, Units units);

}  // namespace dotpose::cli
