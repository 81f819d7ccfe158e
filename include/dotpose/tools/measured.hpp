/// Measured: compares the places of located frames on a sheet or in the world with independently
/// measured places, for example from a motion stage.
///
///     std::vector<MeasuredFrame> frames = ...;
///     const Similarity alignment = align(frames);
///     const Measurement result = compare(std::move(frames), alignment);
///     write_measurement("figures", result);
///
/// Lengths are in mm and angles in radians, in the coordinate frame of the true places: the sheet
/// (y down, clockwise) or the world (y up, counter-clockwise).
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/status.hpp"
#include "dotpose/tools/protocol.hpp"
#include "dotpose/tools/score.hpp"
#include "dotpose/tools/truth.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// A place found in a frame.
struct FoundPlace {
    std::string sheet;
    double x_mm = 0;
    double y_mm = 0;
    double angle_rad = 0;
};

/// One frame with its true place and the found place.
struct MeasuredFrame {
    std::string file;
    std::optional<TruePlace> truth;  ///< none if the frame has no readable pattern
    Status status = Status::ok;
    /// None if there is no fix, or if the place of the fix in the coordinate frame of the truth is
    /// not known.
    std::optional<FoundPlace> found;
    double spacing_mm = kDefaultSpacing_mm;
};

/// Map from the found places to the true places: true = shift + middle + scale * turned(found -
/// middle).
struct Similarity {
    double middle_x_mm = 0;  ///< mean of the found places
    double middle_y_mm = 0;
    double shift_x_mm = 0;  ///< translation of the middle
    double shift_y_mm = 0;
    double turn_rad = 0;  ///< positive in the direction of positive angles
    double scale = 1;
    /// Mean of true minus found angles after the rotation by `turn_rad`. It is the angle from the
    /// image x axis to the heading that was measured independently.
    double angle_offset_rad = 0;
};

/// Returns the least-squares similarity over the frames, with outliers excluded. If all true places
/// are equal, only the shift and the angle offset are determined. Throws Error if no frame has a
/// true and a found place.
Similarity align(std::span<const MeasuredFrame> frames);

/// Difference between the found and the true place of a frame, after the alignment.
struct MeasuredError {
    double x_mm = 0;
    double y_mm = 0;
    std::optional<double> angle_rad;  ///< none if the true angle is not known
    /// True if the fix is wrong: it is on another sheet, there is no true place, or its error is
    /// too large. The error of position or angle is too large if it exceeds both a fixed limit
    /// (half a spacing, 2 degrees) and ten times the median error.
    bool is_wrong = false;
};

/// All frames with their errors.
struct Measurement {
    std::vector<MeasuredFrame> frames;
    std::vector<std::optional<MeasuredError>> errors;  ///< error of each frame; none if the frame
                                                       ///< has no fix
    std::optional<Similarity> alignment;  ///< none if places were compared without alignment
    bool is_in_world = false;

    // Numbers of correct and wrong fixes, and statistics of the errors of correct fixes.
    int located = 0;
    int wrong = 0;
    Quantiles position_um;
    Quantiles angle_deg;
    Spread x_um;
    Spread y_um;
};

/// Compares found and true places, after the alignment if there is one.
Measurement compare(std::vector<MeasuredFrame> frames, const std::optional<Similarity>& alignment);

/// Returns the result as (name, value) pairs for tables.
std::vector<std::pair<std::string, std::string>> described(const Measurement& measurement);

/// Writes one line for each frame: true place, found place and error.
void write_errors_csv(std::ostream& out, const Measurement& measurement);

/// Writes positions.csv, figure-13 and figure-14. If the true angles differ, also writes angles.csv
/// and figure-15. The figures correspond to the figures of the paper. Each figure is written as
/// .svg and .png. Frames with the same true place are samples of one position.
void write_measurement(const std::filesystem::path& folder, const Measurement& measurement);

}  // namespace dotpose

DOTPOSE_END_EXPORT
