// Frame panels: the parts that `draw_frame` puts together. Each draws in a coordinate system of its
// own, from (0, 0).
#pragma once

#include "draw/frame_view.hpp"

namespace dotpose::draw {

/// Paper Fig. 2 and 3, drawn on the frame.
void draw_detection(const FrameView& view, Svg& svg);

/// Paper Fig. 4: the connections from one origin, in a square of this side.
void draw_edges(const FrameView& view, double side, Svg& svg);

/// Paper Fig. 9, drawn on the (faded) frame.
void draw_reading(const FrameView& view, Svg& svg);

/// The pose, or why there is none.
void draw_caption(const FrameView& view, const DrawOptions& draw_options, double width, Svg& svg);

}  // namespace dotpose::draw
