/// Drawing: pictures (self-contained SVG) of what `locate` saw in a frame, stage by stage, of paths
/// over a sheet, of calibrations, of checked prints and of evaluations. The stages contain no code
/// for it: drawing reads the trace, or the result of what it shows.
///
///     const dotpose::Fix fix = locator.locate(image.view());
///     draw_frame("frame.svg", image.view(), locator.trace());
///
/// Functions throw Error when a file cannot be written; they share no state. Texts must be UTF-8;
/// bytes that are not are replaced.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>

#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/image.hpp"
#include "dotpose/trace.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

struct LensCalibration;
struct PrintCheck;
struct Protocol;
struct SpinCalibration;
struct Stitching;
struct Sweep;

/// The content of the caption of `draw_frame`, besides the fix.
struct DrawOptions {
    /// Spacing of the printed grid, for the pose in mm. Not a number: unknown, the pose is in
    /// spacings.
    double spacing_mm = kDefaultSpacing_mm;
    /// The fix as corrected by a camera file or refused after it was located; default: that of the
    /// trace.
    std::optional<Fix> fix{};
    std::string title{};  ///< for example the name of the file; default: none
    /// Place of the fix on a sheet. The large numbers of the caption are then those of the world,
    /// or of the sheet if its pose in the world is not known; default: those of the pattern.
    std::optional<SheetPlace> place{};
    /// Why there is no fix and what would help, for the caption; default: the message of the
    /// status.
    std::string reason{};
};

/// Draws the last frame of a Locator, whatever stage it reached; `image` must be the one it
/// located, with `Options::show_stages` set.
///
/// On the left, over the image (paper Fig. 2 and 3): a ring around each dot, the symmetric
/// connections of the neighbour search, the centre of the intact neighbourhood. Below it the same
/// connections from one origin, with the grid vectors (Fig. 4). On the right (Fig. 9): the grid,
/// each dot's symbol as read on the pattern, coloured by its likelihood, the window that was
/// decoded and its corner, the reference point and the angle theta. Below: the pose, or why there
/// is none.
///
/// With lens distortion everything is drawn where the image shows it, so grid lines are curved.
/// Large images are embedded reduced, and dots too close together for letters are drawn as points,
/// which keeps the picture of a photo below 1 MB.
void draw_frame(std::ostream& out, ImageView image, const Trace& trace,
                const DrawOptions& draw_options = {});
void draw_frame(const std::filesystem::path& path, ImageView image, const Trace& trace,
                const DrawOptions& draw_options = {});

/// One frame of a drive over a sheet, in sheet coordinates.
struct PathPoint {
    double true_x_mm = 0;
    double true_y_mm = 0;
    bool is_fix = false;
    double measured_x_mm = 0;  ///< valid if `is_fix`
    double measured_y_mm = 0;
};

/// Draws the true path on the page with the measured points on it, and the errors, far too small to
/// be seen there, as a scatter plot and over the frame number.
void draw_path(std::ostream& out, const Sheet& sheet, std::span<const PathPoint> path,
               const std::string& title = {});
void draw_path(const std::filesystem::path& file, const Sheet& sheet,
               std::span<const PathPoint> path, const std::string& title = {});

/// Draws the residual fields before and after calibration, and the dots' coverage of the image.
void draw_calibration(const std::filesystem::path& path, const LensCalibration& calibration);

/// Draws where the camera was while the robot turned, and where each frame places the centre of
/// rotation.
void draw_spin(const std::filesystem::path& path, const SpinCalibration& calibration);

/// Draws how sheets lie, by the sheet file before and as stitched, with the disagreement of frames
/// over the seams.
void draw_stitching(const std::filesystem::path& path, std::span<const SheetEntry> before,
                    const Stitching& stitching);

/// Draws the sheets where they lie in the world, seen from above with x to the right and y up, and
/// beside them those whose pose in the world is not known. Throws Error if the sheets lie farther
/// apart than can be drawn.
void draw_sheets(const std::filesystem::path& path, std::span<const SheetEntry> sheets);

/// Draws the deviations of all fields of a printed page over the outline of its scan, enlarged.
void draw_distortion(const std::filesystem::path& path, const ImageView& scan,
                     const PrintCheck& check);

/// Draws Fig. 13 of the paper: the accuracy of x over the positions.
void draw_figure_13(std::ostream& out, const Protocol& protocol);
/// Draws Fig. 14 of the paper: the accuracy of y over the positions.
void draw_figure_14(std::ostream& out, const Protocol& protocol);
/// Draws Fig. 15 of the paper: the accuracy of theta over the angles.
void draw_figure_15(std::ostream& out, const Protocol& protocol);

/// Draws the success rate and the errors of both decoders over the condition that was varied.
void draw_sweep(std::ostream& out, const Sweep& sweep);

}  // namespace dotpose

#pragma GCC visibility pop
