/// Ink shapes in the sharp image, before blur and motion are applied, and functions that create the
/// shapes and expose frames.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "dotpose/tools/simulate.hpp"

namespace dotpose::simulate {

struct InkEllipse {
    Vec2 centre_px;
    /// The outline is the set of points p with (p - centre)^T M^-1 (p - centre) = 1, where M = [xx
    /// xy; xy yy].
    double xx = 0;
    double xy = 0;
    double yy = 0;
    double reflectance = 0;  ///< reflected light relative to bare paper, 0 to 1
};

/// The image of a convex area. The corners are in clockwise or counter-clockwise order.
struct InkPolygon {
    std::vector<Vec2> corners_px;
    double reflectance = 0;
};

struct Ink {
    std::vector<InkEllipse> ellipses;
    std::vector<InkPolygon> polygons;
};

/// The view of a camera: its projection, and a margin around the image.
struct View {
    CameraModel camera;
    CameraPose pose;
    Projection projection;
    /// Maximum distance from the image border, in px, at which ink can affect the image through
    /// blur and motion.
    double margin_px;

    View(const CameraModel& camera_in, const CameraPose& pose_in, const Imperfections& blurred);
};

/// A rectangle that contains everything in view. Its corners are offsets from the pose point.
struct OffsetBox {
    Vec2 low_mm;
    Vec2 high_mm;
};
OffsetBox visible_offsets(const View& view);

/// Adds the image of a disc if it is in view. `offset_mm` is the offset of its centre from the pose
/// point. `reflectance` is relative to bare paper.
void add_disc(Ink& ink, const View& view, Vec2 offset_mm, double radius_mm, double reflectance);

/// Function that returns the offset of a cell's dot from its intersection, in units of the
/// displacement length.
using DisplacementOf = std::function<Vec2(Cell)>;

/// Adds the visible dots of the page, with their printing errors.
void add_dots(Ink& ink, const View& view, const Page& page, const Imperfections& imperfections,
              const DisplacementOf& displacement_of);

DisplacementOf code_of(const Pattern& pattern);

/// A line with round ends.
struct Stroke {
    Vec2 from_mm;  ///< end points, as offsets from the pose point
    Vec2 to_mm;
    double width_mm = 0;
};
void add_stroke(Ink& ink, const View& view, const Stroke& stroke, double reflectance);

/// A row of letters. `at_mm` is the bottom left corner of the first letter, as an offset from the
/// pose point.
struct Word {
    Vec2 at_mm;
    double angle_rad = 0;
    double height_mm = 0;
    int letters = 0;
    double stroke_mm = 0;
};
/// Width of a letter plus the gap after it, as a fraction of the letter height.
inline constexpr double kLetterAdvance = 0.75;
void add_word(Ink& ink, const View& view, const Word& word, double reflectance, Rng& rng);

/// Adds `imperfections.graphics` thick strokes or words at random positions in view.
void add_graphics(Ink& ink, const View& view, const Imperfections& imperfections, Rng& rng);

/// Adds `imperfections.dirt_blobs` elliptical specks. The longer axis of a speck is 0.6 to 3 times
/// the diameter of a dot.
void add_dirt(Ink& ink, const View& view, double dot_mm, const Imperfections& imperfections,
              Rng& rng);

/// Throws BadArgument if a value is out of range.
void check(const Page& page, const CameraModel& camera, const CameraPose& pose,
           const Imperfections& imperfections);

/// Computes the grey levels of a frame from paper, light and ink. Blur, motion and the area of the
/// pixels are simulated. The levels are in row-major order, contain no noise and are not rounded.
std::vector<float> expose(const Ink& ink, const View& view, const Page& page,
                          const Imperfections& imperfections);
/// Computes the grey levels of a frame that shows a page image. The levels are in row-major order,
/// contain no noise and are not rounded.
std::vector<float> expose(const PageImage& page, const View& view,
                          const Imperfections& imperfections);

/// Adds noise to the grey levels, clamps them to [0, 255] and rounds them.
GreyImage read_out(const std::vector<float>& levels, const CameraModel& camera,
                   const Imperfections& imperfections, Rng& rng);

}  // namespace dotpose::simulate
