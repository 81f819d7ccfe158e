/// Drawing: writes self-contained SVG pictures. They show the stages of `locate` for one frame, the
/// path of a camera over a sheet, or the result of a calibration, a print check or an evaluation.
///
///     const dotpose::Fix fix = locator.locate(image.view());
///     draw_frame("frame.svg", image.view(), locator.trace());
///
/// Functions share no state. They throw Error if a file cannot be written. Text must be UTF-8.
/// Invalid bytes are replaced.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/image.hpp"
#include "dotpose/trace.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

struct LensCalibration;
struct MapPage;
struct PrintCheck;
struct Protocol;
struct SpinCalibration;
struct Stitching;
struct Sweep;

/// Options for the caption of `draw_frame`.
struct DrawOptions {
    /// Spacing of the printed grid, for converting the pose to mm. If it is NaN, the pose is shown
    /// in spacings.
    double spacing_mm = kDefaultSpacing_mm;
    /// The fix to show, for example a fix that was corrected with a camera file, or rejected after
    /// `locate`. Default: the fix in the trace.
    std::optional<Fix> fix{};
    std::string title{};  ///< title of the caption, for example the name of the file, or empty
    /// Place of the fix on a sheet. If given, the caption shows the pose in large type. This pose
    /// is in world coordinates, or in sheet coordinates if the world pose of the sheet is unknown.
    /// If no place is given, the caption shows the pose in the pattern frame.
    std::optional<SheetPlace> place{};
    /// Text of the caption if there is no fix: the reason and the remedy. Default: the message for
    /// the status.
    std::string reason{};
};

/// Draws the last frame that a Locator processed, with all stages that the frame reached. `image`
/// must be the image of this frame, and `DeviceOptions::show_stages` must be set.
///
/// The left panel shows the image with a ring around each dot, the symmetric connections of the
/// neighbour search, and the origin of the grid (paper, figures 2 and 3). Below the panel, the same
/// connections are drawn from a common origin, with the grid vectors (figure 4). The right panel
/// shows the decoding (figure 9): the grid, the symbol of each dot (coloured by its likelihood),
/// the decoded window and its corner, the reference point, and the angle theta. Below the panel is
/// the pose, or the reason why there is none.
///
/// Everything is drawn at its position in the image, so grid lines are curved if the lens has
/// distortion. To keep the file size below 1 MB, large images are embedded at a lower resolution.
/// If the dots are too close together to show the letters of their symbols, they are drawn as
/// points.
void draw_frame(std::ostream& out, ImageView image, const Trace& trace,
                const DrawOptions& draw_options = {});
void draw_frame(const std::filesystem::path& path, ImageView image, const Trace& trace,
                const DrawOptions& draw_options = {});

/// One frame recorded during a drive over a sheet. Positions are in sheet coordinates.
struct PathPoint {
    double true_x_mm = 0;
    double true_y_mm = 0;
    bool is_fix = false;
    double measured_x_mm = 0;  ///< valid if `is_fix`
    double measured_y_mm = 0;
};

/// Draws the true path and the measured points on the page. The errors are too small to be visible
/// on the page, so they are also drawn as a scatter plot, and as a function of the frame number.
void draw_path(std::ostream& out, const Sheet& sheet, std::span<const PathPoint> path,
               const std::string& title = {});
void draw_path(const std::filesystem::path& file, const Sheet& sheet,
               std::span<const PathPoint> path, const std::string& title = {});

/// Draws the mean residual in each part of the image, before and after the calibration, and a map
/// of the dot density.
void draw_calibration(const std::filesystem::path& path, const LensCalibration& calibration);

/// Sums of the residuals of a lens calibration. `draw_calibration` divides the image into square
/// parts, and this struct contains the sums for each part. Programs can use the sums to draw the
/// residuals themselves.
struct ResidualField {
    struct Part {
        PixelPoint before;  ///< sum of the residuals before the calibration, in px
        PixelPoint after;   ///< sum of the residuals after the calibration, in px
        int dots = 0;
    };

    double part_px = 0;  ///< side length of a part
    int columns = 0;
    int rows = 0;
    std::vector<Part> parts;  ///< row by row
};
ResidualField residual_field(const LensCalibration& calibration);

/// Draws the positions of the camera while the robot turns, and the centre of rotation computed
/// from each frame.
void draw_spin(const std::filesystem::path& path, const SpinCalibration& calibration);

/// Draws the sheets before and after stitching. Each frame that shows two sheets yields two
/// positions of the image centre, one from each sheet. An arrow connects the two positions.
void draw_stitching(const std::filesystem::path& path, std::span<const SheetEntry> before,
                    const Stitching& stitching);

/// Draws the print map of a page: the smooth distortion as a deformed grid (exaggerated), and the
/// offsets of all dots as two images, one for x and one for y.
void draw_print_map(const std::filesystem::path& path, const MapPage& page);

/// Draws the sheets in the world, seen from above with x to the right and y up. Sheets without a
/// known pose are drawn beside the other sheets. Throws Error if the sheets are too far apart to be
/// drawn.
void draw_sheets(const std::filesystem::path& path, std::span<const SheetEntry> sheets);

/// Draws the outline of the scan, and the deviations of the dots in all fields
/// (`PrintField::distortion`) at an enlarged scale.
void draw_distortion(const std::filesystem::path& path, const ImageView& scan,
                     const PrintCheck& check);

/// Draws figure 13 of the paper: the accuracy of x at each position.
void draw_figure_13(std::ostream& out, const Protocol& protocol);
/// Draws figure 14 of the paper: the accuracy of y at each position.
void draw_figure_14(std::ostream& out, const Protocol& protocol);
/// Draws figure 15 of the paper: the accuracy of theta at each angle.
void draw_figure_15(std::ostream& out, const Protocol& protocol);

/// Draws the success rate and the errors of both decoders as functions of the varied condition.
void draw_sweep(std::ostream& out, const Sweep& sweep);

}  // namespace dotpose

DOTPOSE_END_EXPORT
