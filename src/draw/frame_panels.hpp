// The parts of the picture that `draw_frame` makes. Each draws in its own coordinate system, whose
// top left corner is (0, 0).
#pragma once

#include "draw/frame_view.hpp"

namespace dotpose::draw {

/// Draws the dots and the edges between neighbours on the frame, as the paper's Fig. 2 and 3.
void draw_detection(const FrameView& view, Svg& svg);

/// Draws all edges from a common origin in a square with this side, as the paper's Fig. 4.
void draw_edges(const FrameView& view, double side, Svg& svg);

/// Draws the grid and the symbols that were read on a faded frame, as the paper's Fig. 9.
void draw_reading(const FrameView& view, Svg& svg);

/// Writes the pose, or the reason why there is none.
void draw_caption(const FrameView& view, const DrawOptions& draw_options, double width, Svg& svg);

}  // namespace dotpose::draw
