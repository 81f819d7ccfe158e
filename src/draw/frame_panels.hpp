// Panels of the drawing that `draw_frame` produces. The origin of each panel is its top left
// corner.
#pragma once

#include "draw/frame_view.hpp"

namespace dotpose::draw {

/// Draws the dots and the edges between neighbours on the frame, as in figures 2 and 3 of the
/// paper.
void draw_detection(const FrameView& view, Svg& svg);

/// Draws all edges from a common origin, as in figure 4 of the paper. `side` is the side length of
/// the square plot.
void draw_edges(const FrameView& view, double side, Svg& svg);

/// Draws the grid and the symbols on a faded frame, as in figure 9 of the paper.
void draw_reading(const FrameView& view, Svg& svg);

/// Writes the pose, or the reason why there is no pose.
void draw_caption(const FrameView& view, const DrawOptions& draw_options, double width, Svg& svg);

}  // namespace dotpose::draw
