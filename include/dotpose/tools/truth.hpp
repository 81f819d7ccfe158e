/// Truth: the known poses of frames, from the simulator or from a truth.csv file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/tools/simulate.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// The true pose of a frame, using the conventions of `Fix`.
struct Truth {
    bool has_pose = true;  ///< false if the frame has no readable pattern and must be rejected
    double x_grid = 0;
    double y_grid = 0;
    double theta_rad = 0;
    /// Section of the pose. If it is none, the section of the fix is not checked.
    std::optional<Section> section;
    double spacing_mm = kDefaultSpacing_mm;
};

/// Returns the true pose of a simulated frame.
Truth truth_of(const Shot& shot);

/// The true pose of an image, in a sheet frame or in the world frame of a sheet file.
struct TruePlace {
    /// True for the world: y points up, and angles are counter-clockwise. False for a sheet: y
    /// points down, and angles are clockwise.
    bool is_in_world = false;
    std::string sheet;  ///< name of the sheet, or empty if not known
    double x_mm = 0;
    double y_mm = 0;
    std::optional<double> angle_rad;
};

/// One line of truth.csv.
struct TruthRow {
    std::string file;
    Truth truth;                      ///< valid if `is_in_pattern`
    bool is_in_pattern = true;        ///< true if the file contains poses in the pattern frame
    std::optional<CodeVariant> code;  ///< printed code variant, if the file contains it
    /// Place on a sheet or in the world, if the file contains it.
    std::optional<TruePlace> place;
};

/// Reads a truth.csv file written by `dotpose simulate`, or a file with poses measured on a sheet
/// or in the world. Columns are identified by name and may be in any order. The `file` column and
/// one of these groups of columns are required:
///   - x_grid, y_grid or x_mm, y_mm (grid units take precedence), and theta_deg;
///   - x_sheet_mm, y_sheet_mm; optional theta_sheet_deg, sheet;
///   - x_m, y_m (they take precedence over places on sheets); optional sheet, and yaw_rad or
///     yaw_deg (yaw_rad takes precedence).
/// Other optional columns are section_u, section_v, code and spacing_mm. If the pose of a row is
/// empty, the frame has no readable pattern. If a row has no spacing, its spacing is
/// kDefaultSpacing_mm. The argument `spacing_mm`, if given, replaces the spacings of all rows.
/// Throws Error if the file cannot be read, contains no frames, or has invalid content. The message
/// contains the name of the file and, for an invalid line, the line number.
std::vector<TruthRow> read_truth(const std::filesystem::path& path,
                                 std::optional<double> spacing_mm = std::nullopt);

}  // namespace dotpose

DOTPOSE_END_EXPORT
