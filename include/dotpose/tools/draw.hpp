/// Drawing: pictures (SVG, self-contained) of what `locate` saw in a frame, stage by stage, and of
/// paths over a sheet. The stages themselves know nothing of it: all is read from the trace.
///
///     const dotpose::Fix fix = locator.locate(image.view());
///     draw_frame("frame.svg", image.view(), locator.trace());
///
/// Functions throw Error when a file cannot be written; they share no state. Texts are expected in
/// UTF-8; what is not is replaced.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>

#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/image.hpp"
#include "dotpose/trace.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// What the caption of `draw_frame` says besides the fix.
struct DrawOptions {
    /// Of the printed grid, for the pose in mm. Not a number: not known, the pose is in spacings.
    double spacing_mm = kDefaultSpacing_mm;
    std::string title;  ///< for example the file's name; default none
};

/// Draws the last frame of a Locator, whatever stage it got to; `image` is the one it located, and
/// `Options::show_stages` was set.
///
/// Left, on the image (paper Fig. 2 and 3): a ring around each dot, the symmetric connections of
/// the neighbour search, the centre of the intact neighbourhood. Below it the same connections from
/// one origin, with the grid vectors (Fig. 4). Right (Fig. 9): the grid, each dot's symbol as read
/// on the pattern, coloured by its likelihood, the window that was decoded and its corner, the
/// reference point and the angle theta. Below: the pose, or why there is none.
///
/// With lens distortion everything is drawn where the image shows it, so grid lines bend.
void draw_frame(std::ostream& out, ImageView image, const Trace& trace,
                const DrawOptions& draw_options = {});
void draw_frame(const std::filesystem::path& path, ImageView image, const Trace& trace,
                const DrawOptions& draw_options = {});

/// One frame of a drive over a sheet; sheet coordinates.
struct PathPoint {
    double true_x_mm = 0;
    double true_y_mm = 0;
    bool is_fix = false;
    double measured_x_mm = 0;  ///< if it is a fix
    double measured_y_mm = 0;
};

/// Draws the true path on the page with the measured points on it, and the errors, far too small to
/// be seen there: as a scatter plot and over the frame number.
void draw_path(std::ostream& out, const Sheet& sheet, std::span<const PathPoint> path,
               const std::string& title = {});
void draw_path(const std::filesystem::path& file, const Sheet& sheet,
               std::span<const PathPoint> path, const std::string& title = {});

}  // namespace dotpose

#pragma GCC visibility pop
