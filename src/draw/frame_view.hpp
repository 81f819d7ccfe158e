// Frame view: a frame on the drawing, and how far `locate` got with it.
#pragma once

#include "dotpose/tools/draw.hpp"
#include "draw/svg.hpp"

namespace dotpose::draw {

/// How far `locate` got.
struct Reached {
    bool undistorted = false;  ///< dot centres are where a camera without distortion sees them
    bool edges = false;        ///< connections between neighbours
    bool axes = false;         ///< the grid vectors
    bool cells = false;        ///< likelihoods
    bool window = false;       ///< the 8 x 8 cells read most clearly
    bool place = false;        ///< a position and which way up, be it certain or not
    bool pose = false;         ///< a fix
};
Reached reached(const Trace& trace);

/// A PlaneFromImage, both ways.
class Plane {
  public:
    explicit Plane(const PlaneFromImage& map);

    Point plane_point(Point image_px) const;
    Point image_point(Point plane_point) const;
    /// At the centre.
    double spacing_px() const;

  private:
    double divisor(Point from_centre_px) const;

    Point centre_px_;
    Point at_centre_;
    Point du_;
    Point dv_;
    Point perspective_;
    double lens_;
    double area_;  ///< of a pixel, in squared spacings
};

/// From pixels to the drawing. *Ideal* pixels are those of a camera without distortion, *image*
/// pixels those of the image.
class FrameView {
  public:
    FrameView(ImageView image, const Trace& trace, double side);

    const Trace& trace() const { return trace_; }
    const Reached& reached() const { return reached_; }
    double width() const { return width_px_ * scale_; }
    double height() const { return height_px_ * scale_; }
    /// Of one pixel.
    double scale() const { return scale_; }
    /// Of strokes: 1 for a grid that shows at 70 units or more, less for smaller ones.
    double stroke() const { return stroke_; }
    /// The grid spacing on the drawing; a guess as long as there is no grid.
    double spacing() const { return spacing_px_ * scale_; }

    /// On the drawing, from ideal pixels.
    Point at(Point ideal_px) const;
    Point at_dot(const Dot& dot) const;
    /// On the drawing, from grid coordinates; needs `reached().cells`.
    Point at_grid(double i, double j) const;
    /// The point whose pose is wanted, ideal pixels.
    Point reference_px() const { return reference_px_; }
    /// The direction of the pattern's x axis on the drawing, at the reference point; length 1.
    /// Needs `reached().pose`.
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

/// The grid cell of the window's top left symbol, as the pattern stands; needs `place`.
Vec window_corner(const Trace& trace);
/// Where a cell of the grid stands in the code; needs `place`.
Place place_of(const Trace& trace, Vec grid_cell);

/// Fixed point to pixels.
Point from_q8(Vec q8);
Point from_q16(Vec q16);

}  // namespace dotpose::draw
