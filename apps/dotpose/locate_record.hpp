/// The result of `dotpose locate` for one image, and functions that convert the result to an output
/// line.
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
    CodeReading reading;         ///< code variant and the alternative to it, see Located
    bool code_is_given = false;  ///< true if the user or the sheet file specifies the code
    double spacing_mm = 0;       ///< NaN if unknown, in which case fields in mm are empty
    /// Spacing computed from the fix and the camera file, see Located.
    double camera_spacing_mm = std::numeric_limits<double>::quiet_NaN();
    /// Velocity of the camera during the readout of a rolling shutter, see Located.
    std::optional<ReadoutVelocity> velocity;
    bool has_space = false;          ///< true if the record has fields for a pose in space
    std::optional<SpacePose> space;  ///< pose of the camera in space, see Located
    bool has_tip = false;            ///< true if the record has fields for a pen tip
    std::optional<TipPose> tip;      ///< pen tip, see Located
    bool is_pen_down = false;
    MapUse map_use = MapUse::no_map;  ///< how the print map was used, see Located
    bool has_sheets = false;          ///< true if the record has fields for the place on a sheet
    std::optional<SheetPlace> place;  ///< place of the fix, or none if it is not on a sheet
    int min_side_px() const { return has_sheets ? kMinKnownFrameSide_px : kMinFrameSide_px; }
    double elapsed_us = 0;  ///< time to locate the image in µs, or NaN if not measured
    std::string advice;     ///< advice if there is no fix, or empty
    int width_px = 0;
    int height_px = 0;
    int min_dots = 0;          ///< minimum number of dots for a fix
    int max_p_wrong_log2 = 0;  ///< log2 of the maximum p_wrong for which a position is accepted
};

/// Returns the record for the most recently located image. The caller must set the file name, the
/// time and the advice.
Record record_of(const Located& located, const Follower& follower);

/// Length of the array that `warnings` returns.
inline constexpr std::size_t kWarnings = 5;
/// Returns the warnings for a frame. A warning that does not apply is empty. In order, the warnings
/// report that
/// - a code other than the given code explains the frame,
/// - the fix is not on any sheet in the sheet file,
/// - the spacing according to the camera file differs from the spacing of the sheet,
/// - the dots do not exclude the second pose in space,
/// - the dots contradict the print map.
std::array<std::string, kWarnings> warnings(const Record& record);

/// Returns the reason why there is no fix, with the relevant numbers. Returns an empty string if
/// there is a fix.
std::string reason(const Record& record);

/// Returns all fields in output order.
std::vector<Field> fields(const Record& record, Units units);

/// Returns the fields that are output only with --sheets. The `sheet` field is null if the fix is
/// not on any sheet.
std::vector<Field> sheet_fields(const Record& record, Units units);

/// Selection of CSV columns.
enum class Columns {
    /// Pose, standard deviations and p_wrong. With a sheet file, the poses on the sheet and in the
    /// world replace the pose in the pattern frame.
    brief,
    all,
};

/// Returns the fields that the CSV output contains, in their original order.
std::vector<Field> columns_of(std::vector<Field> fields, Columns columns);

/// Returns the CSV header, including the line break, for a run with the options of `follower`.
std::string csv_header(const Follower& follower, Units units, Columns columns);
/// Returns a record without a result. The options of `follower` determine which fields the record
/// has.
Record empty_record(const Follower& follower);

/// Returns one line of text: the file, the sheet, the pose (x, y and angle) with its standard
/// deviations, and the place in the world. If there is no fix, the line contains the reason.
std::string text_line(const Record& record, Units units);

}  // namespace dotpose::cli
