/// Result for one image, written as one output line of `dotpose locate`.
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
    CodeReading reading;         ///< code and alternative places, at the image centre like `fix`
    bool code_is_given = false;  ///< true if the user or the sheet file determines the code
    double spacing_mm = 0;       ///< NaN if unknown, in which case the record has no fields in mm
    /// Spacing computed from the fix and the camera file; see Located.
    double camera_spacing_mm = std::numeric_limits<double>::quiet_NaN();
    /// Velocity of the camera during the readout of a rolling shutter; see Located.
    std::optional<ReadoutVelocity> velocity;
    bool has_space = false;          ///< true if the record has the fields of a pose in space
    std::optional<SpacePose> space;  ///< pose of the camera in space; see Located
    bool has_tip = false;            ///< true if the record has the fields of the tip of a pen
    std::optional<TipPose> tip;      ///< tip of the pen; see Located
    bool is_pen_down = false;
    MapUse map_use = MapUse::no_map;  ///< how the print map was used; see Located
    bool has_sheets = false;          ///< true if the record has the fields of a sheet file
    std::optional<SheetPlace> place;  ///< place of the fix on its sheet, or none if on no sheet
    int min_side_px() const { return has_sheets ? kMinKnownFrameSide_px : kMinFrameSide_px; }
    double elapsed_us = 0;  ///< time taken to locate the image, or NaN if not measured
    std::string advice;     ///< advice for an image without a fix, or empty
    int width_px = 0;
    int height_px = 0;
    int min_dots = 0;          ///< minimum number of dots required to locate an image
    int max_p_wrong_log2 = 0;  ///< log2 of the maximum p_wrong of an accepted position
};

/// Returns the record of an image that was just located. The caller must set file name, time and
/// advice.
Record record_of(const Located& located, const Follower& follower);

/// Number of warnings that `warnings` returns.
inline constexpr std::size_t kWarnings = 5;
/// Returns the warnings for a frame. An empty string means no warning. The warnings are, in this
/// order:
/// - another code than the given code explains the frame,
/// - the place is not on any sheet of the sheet file,
/// - the spacing implied by the camera file differs from the spacing of the sheet,
/// - the dots do not exclude the second pose in space,
/// - the dots contradict the print map.
std::array<std::string, kWarnings> warnings(const Record& record);

/// Returns the reason why there is no fix, with the relevant numbers, or an empty string if there
/// is a fix.
std::string reason(const Record& record);

/// Returns all fields, in the order of the output.
std::vector<Field> fields(const Record& record, Units units);

/// Returns the fields that are present if --sheets is given. `sheet` is null if the fix is not on
/// any sheet.
std::vector<Field> sheet_fields(const Record& record, Units units);

/// Selection of CSV columns.
enum class Columns {
    brief,  ///< pose with standard deviations and p_wrong; with a sheet file, the poses on the
            ///< sheet and in the world
    all,
};

/// Returns the fields that are columns of the CSV output, in the order of `fields`.
std::vector<Field> columns_of(std::vector<Field> fields, Columns columns);

/// Returns the CSV header of a run with the options of a Follower. Ends with a line break.
std::string csv_header(const Follower& follower, Units units, Columns columns);
/// Returns a record without values that has the fields of a run with the options of a Follower.
Record empty_record(const Follower& follower);

/// Returns one line of text, which contains file, sheet, x, y, angle, their standard deviations,
/// and the place in the world. If there is no fix, the line contains the reason.
std::string text_line(const Record& record, Units units);

}  // namespace dotpose::cli
