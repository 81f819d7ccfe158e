// Maps a frame to the drawing, and reports which stages of `locate` succeeded.
#pragma once

#include "base/plane_map.hpp"
#include "dotpose/tools/draw.hpp"
#include "draw/svg.hpp"

namespace dotpose::draw {

/// Stages of `locate` whose results are in the trace.
struct Reached {
    bool undistorted = false;  ///< dot centres, corrected for lens distortion
    bool edges = false;        ///< edges between neighbouring dots
    bool axes = false;         ///< grid vectors
    bool cells = false;        ///< bit likelihoods of each cell
    bool window = false;       ///< 8 x 8 window with the clearest cells
    bool place = false;        ///< position and orientation, not necessarily certain
    bool pose = false;         ///< a fix
};
Reached reached(const Trace& trace);

/// A PlaneMap and its inverse.
class Plane {
  public:
    explicit Plane(const PlaneMap& map);

    Point plane_point(Point image_px) const;
    Point image_point(Point plane_point) const;
    /// Returns the grid spacing at the image centre, or 0 if the map has no inverse.
    double spacing_px() const;

  private:
    double divisor(Point from_centre_px) const;

    Point centre_px_;
    Point at_centre_;
    Point du_;
    Point dv_;
    Point perspective_;
    double lens_;
    double area_;  ///< area that a pixel covers in the plane, in squared spacings
};

/// Maps pixel coordinates to the drawing. Image coordinates refer to the captured image. Ideal
/// coordinates refer to the image that a camera without lens distortion would capture.
class FrameView {
  public:
    FrameView(ImageView image, const Trace& trace, double side);

    const Trace& trace() const { return trace_; }
    const Reached& reached() const { return reached_; }
    double width() const { return width_px_ * scale_; }
    double height() const { return height_px_ * scale_; }
    /// Returns the side length of a pixel in the drawing, in drawing units.
    double scale() const { return scale_; }
    /// Returns true if the dots are too close together in the drawing for legible letters and
    /// rings.
    bool is_dense() const;
    /// Returns the factor for stroke widths: the grid spacing in the drawing divided by 70 units,
    /// clamped to [0.2, 1].
    double stroke() const { return stroke_; }
    /// Returns the grid spacing in the drawing. If no grid was found, it is estimated from the size
    /// of the dots.
    double spacing() const { return spacing_px_ * scale_; }

    /// Converts ideal pixel coordinates to a point in the drawing.
    Point at(Point ideal_px) const;
    Point at_dot(const DetectedDot& dot) const;
    /// Converts grid coordinates to a point in the drawing. Requires `reached().cells`.
    Point at_grid(double i, double j) const;
    /// Returns the reference point of the pose, in ideal pixel coordinates.
    Point reference_px() const { return reference_px_; }
    /// Returns the direction of the pattern's x axis at the reference point as a unit vector in the
    /// drawing. Requires `reached().pose`.
    Point ahead_of_reference() const;

  private:
    Point image_from_ideal(Point ideal_px) const;
    double estimate_spacing_px() const;

    Trace trace_;
    Reached reached_;
    double width_px_;
    double height_px_;
    double scale_;
    double k_;
    Point lens_centre_px_;
    Plane grid_;
    double spacing_px_ = 0;
    double stroke_ = 1;
    Point reference_px_;
};

/// Returns the grid cell at one corner of the 8 x 8 window: the top left corner if the pattern is
/// viewed upright. Requires `Reached::place`.
FixedVec window_corner(const Trace& trace);
/// Returns the position of a grid cell in the code. Requires `Reached::place`.
Place place_of(const Trace& trace, FixedVec grid_cell);

/// Converts a point from units of 1/256 px to px.
Point from_q8(FixedVec q8);
Point from_q16(FixedVec q16);

}  // namespace dotpose::draw
