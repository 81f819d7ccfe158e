/// Ink: the strokes that a pen wrote, computed from the poses of its tip.
///
///     const std::vector<InkPage> pages = ink_of(samples);
///     for (const InkPage& page : pages)
///         write_file(page.name + ".svg", ink_svg(page));
///
/// `ink_of` is in the dotpose::follow library. `ink_svg` and `ink_ml`, which return the contents of
/// files, are in dotpose::draw. All functions are pure and thread-safe.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Pose of the pen tip in one frame.
struct InkSample {
    double t_s = 0;
    std::string page;  ///< name of the page under the tip, or empty if there are no sheets
    double x_mm = 0;   ///< position in the page or pattern frame: x right, y DOWN
    double y_mm = 0;
    double height_mm = 0;
    double sigma_x_mm = 0;  ///< standard deviations, above 0
    double sigma_y_mm = 0;
    double sigma_height_mm = 0;
    double tilt_rad = 0;  ///< tilt and azimuth as defined in CameraLean
    double azimuth_rad = 0;
};

struct InkPoint {
    double t_s = 0;
    double x_mm = 0;
    double y_mm = 0;
    double tilt_rad = 0;
    double azimuth_rad = 0;
};

/// Path of the tip while it is on the paper, from pen-down to pen-up.
using InkStroke = std::vector<InkPoint>;

struct InkPage {
    std::string name;  ///< empty if there are no sheets
    /// Size of the page, and coordinates of its top left corner in the frame of the points. Set by
    /// the caller if the page is known. If the width is 0, the bounding box of the strokes is used
    /// as the page.
    double width_mm = 0;
    double height_mm = 0;
    double left_mm = 0;
    double top_mm = 0;
    std::vector<InkStroke> strokes;
};

/// Maximum interval between consecutive samples of a stroke. A longer interval ends the stroke.
inline constexpr double kMaxInkGap_s = 0.1;

/// Returns the strokes on each page. The pages are ordered by their first strokes. `samples` must
/// be ordered by time.
///
/// The path is estimated by a fixed-interval smoother (Rauch, Tung and Striebel 1965). In its
/// motion model, the acceleration is driven by white noise, whose power is chosen to maximise the
/// likelihood of the samples. PenContact detects when the pen is lifted from the paper. PenContact
/// reports the start of a lift late and the end early, so each lift is extended to the adjacent
/// samples whose smoothed heights are clearly above the paper.
std::vector<InkPage> ink_of(std::span<const InkSample> samples);

/// Returns the page as SVG. The image has the size of the page, and its unit is mm.
std::string ink_svg(const InkPage& page);

/// Returns the page as W3C InkML, with the channels X and Y (in mm from the top left corner), T (in
/// ms), and OTx and OTy (tilts, in degrees).
std::string ink_ml(const InkPage& page);

}  // namespace dotpose

DOTPOSE_END_EXPORT
