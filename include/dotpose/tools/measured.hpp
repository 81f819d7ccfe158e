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

/// Place of a frame's fix, in the coordinate frame of the true places.
struct FoundPlace {
    std::string sheet;
    double x_mm = 0;
    double y_mm = 0;
    double angle_rad = 0;
};

/// One frame, with its true place and the place that was found.
struct MeasuredFrame {
    std::string file;
    std::optional<TruePlace> truth;  ///< none if the frame has no readable pattern
    Status status = Status::ok;
    /// None if there is no fix, or if the fix has no known place in the coordinate frame of the
    /// true places.
    std::optional<FoundPlace> found;
    double spacing_mm = kDefaultSpacing_mm;
};

/// Map from the found places to the true places: true = middle + shift + scale * R (found -
/// middle), where R is the rotation by `turn_rad`.
struct Similarity {
    double middle_x_mm = 0;  ///< mean of the found places
    double middle_y_mm = 0;
    double shift_x_mm = 0;  ///< true position of the middle minus its found position
    double shift_y_mm = 0;
    /// Rotation angle, with the sign convention of the coordinate frame.
    double turn_rad = 0;
    double scale = 1;
    /// Mean difference between the true angles and the found angles, after adding `turn_rad` to the
    /// found angles. This is the angle from the image x axis to the independently measured heading.
    /// 0 if no true angle is known.
    double angle_offset_rad = 0;
};

/// Fits the found places to the true places by least squares, excluding outliers. If all true
/// places are equal, `turn_rad` is 0 and `scale` is 1. Throws Error if no frame has a true place
/// and a found place on the same sheet.
Similarity align(std::span<const MeasuredFrame> frames);

/// Error of a frame: its found place minus its true place, after the alignment. 0 if the frame has
/// no true place.
struct MeasuredError {
    double x_mm = 0;
    double y_mm = 0;
    std::optional<double> angle_rad;  ///< none if the true angle is not known
    /// True if the fix is wrong: there is no true place, the true place is on another sheet, or the
    /// position or angle error is too large. An error is too large if it exceeds both a fixed limit
    /// (half a spacing, 2 degrees) and ten times the median error.
    bool is_wrong = false;
};

/// All frames with their errors.
struct Measurement {
    std::vector<MeasuredFrame> frames;
    /// Error of each frame. None if the frame has no found place.
    std::vector<std::optional<MeasuredError>> errors;
    /// Alignment of the found places. None if the places were compared without an alignment.
    std::optional<Similarity> alignment;
    bool is_in_world = false;

    // Numbers of correct and wrong fixes, and statistics of the errors of correct fixes. A fix
    // without a found place is counted as wrong.
    int located = 0;
    int wrong = 0;
    Quantiles position_um;
    Quantiles angle_deg;
    Spread x_um;
    Spread y_um;
};

/// Compares the found places with the true places. If there is an alignment, applies it to the
/// found places first.
Measurement compare(std::vector<MeasuredFrame> frames, const std::optional<Similarity>& alignment);

/// Returns the result as (name, value) pairs for tables.
std::vector<std::pair<std::string, std::string>> described(const Measurement& measurement);

/// Writes one line per frame: true place, found place and error.
void write_errors_csv(std::ostream& out, const Measurement& measurement);

/// Writes positions.csv, figure-13 and figure-14. If the true angles are not all equal, also writes
/// angles.csv and figure-15. The figures correspond to the figures with the same numbers in the
/// paper. Each figure is written as .svg and .png. Frames with the same true place are treated as
/// samples of one position. Throws Error if no frame has a true place, or if a file cannot be
/// written.
void write_measurement(const std::filesystem::path& folder, const Measurement& measurement);

}  // namespace dotpose

DOTPOSE_END_EXPORT
