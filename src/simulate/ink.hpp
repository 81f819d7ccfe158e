/// Ink as shapes in the image: what the lens would show without blur.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "dotpose/tools/simulate.hpp"

namespace dotpose::simulate {

/// The image of a round dot.
struct InkEllipse {
    Vec2 centre_px;
    /// The outline is the set of p with (p - centre)^T M^-1 (p - centre) = 1, M = [xx xy; xy yy].
    double xx = 0;
    double xy = 0;
    double yy = 0;
    double reflectance = 0;  ///< relative to paper
};

/// A convex area; corners in either order.
struct InkPolygon {
    std::vector<Vec2> corners_px;
    double reflectance = 0;
};

struct Ink {
    std::vector<InkEllipse> ellipses;
    std::vector<InkPolygon> polygons;
};

/// What is needed to place ink in the image.
struct View {
    CameraModel camera;
    CameraPose pose;
    Projection projection;
    double margin_px;  ///< ink this far outside the image still reaches it by blur and motion

    View(const CameraModel& camera_in, const CameraPose& pose_in, const Imperfections& blurred);
};

/// A rectangle of offsets that holds all that the view shows.
struct OffsetBox {
    Vec2 low_mm;
    Vec2 high_mm;
};
OffsetBox visible_offsets(const View& view);

/// The image of a disc; nothing is added if it is out of view.
void add_disc(Ink& ink, const View& view, Vec2 offset_mm, double radius_mm, double reflectance);

/// Where the dot of a cell lies from its intersection, in units of the displacement length.
using DisplacementOf = std::function<Vec2(Cell)>;

/// Adds the page's dots in view, with their printing errors.
void add_dots(Ink& ink, const View& view, const Page& page, const Imperfections& imperfections,
              const DisplacementOf& displacement_of);

DisplacementOf code_of(const Pattern& pattern);

/// A line with round ends.
struct Stroke {
    Vec2 from_mm;  ///< offsets from the pose point
    Vec2 to_mm;
    double width_mm = 0;
};
void add_stroke(Ink& ink, const View& view, const Stroke& stroke, double reflectance);

/// Letters on a line that starts at `at_mm` (offset, bottom left of the first letter).
struct Word {
    Vec2 at_mm;
    double angle_rad = 0;
    double height_mm = 0;
    int letters = 0;
    double stroke_mm = 0;
};
/// Width of a letter and the gap after it, in letter heights.
inline constexpr double kLetterAdvance = 0.75;
void add_word(Ink& ink, const View& view, const Word& word, double reflectance, Rng& rng);

/// `imperfections.graphics` thick strokes or words at random places in view.
void add_graphics(Ink& ink, const View& view, const Imperfections& imperfections, Rng& rng);

/// `imperfections.dirt_blobs` specks of 0.6 to 3 dot diameters.
void add_dirt(Ink& ink, const View& view, double dot_mm, const Imperfections& imperfections,
              Rng& rng);

/// Throws BadArgument on a value out of its range.
void check(const Page& page, const CameraModel& camera, const CameraPose& pose,
           const Imperfections& imperfections);

/// Paper, light, blur, motion, integration over each pixel: exact grey levels, row by row.
std::vector<float> expose(const Ink& ink, const View& view, const Page& page,
                          const Imperfections& imperfections);
/// The same of a page given as an image.
std::vector<float> expose(const PageImage& page, const View& view,
                          const Imperfections& imperfections);

/// Noise, clipping, rounding.
GreyImage read_out(const std::vector<float>& levels, const CameraModel& camera,
                   const Imperfections& imperfections, Rng& rng);

}  // namespace dotpose::simulate
