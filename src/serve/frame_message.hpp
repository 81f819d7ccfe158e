// A frame with its dots, grid and pose, as a message for the web page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/image.hpp"
#include "dotpose/trace.hpp"
#include "draw/svg.hpp"

namespace dotpose::serve {

/// Shapes drawn over a frame. Points are in px from the upper left corner of the frame.
struct FrameOverlay {
    std::vector<draw::Point> dots;
    /// Lines of the grid. Lens distortion bends the lines, so each line has several points.
    std::vector<std::vector<draw::Point>> grid;
    double spacing_px = 0;  ///< spacing of the grid
    /// The reference point of the pose, and the directions of the x and y axes of the pattern.
    struct Axes {
        draw::Point at;
        draw::Point x;
        draw::Point y;
    };
    std::optional<Axes> axes;  ///< nullopt if there is no fix
};

/// Returns the overlay for the last frame that a Locator processed. `image` must be the located
/// image, and `DeviceOptions::show_stages` must be set.
FrameOverlay overlay_of(ImageView image, const Trace& trace);

/// Returns the message: the size of the JSON in bytes (32 bits, little-endian), the JSON, and the
/// frame as JPEG, reduced so that its longer side is at most `max_side_px`. The JSON contains the
/// number of the frame, the original size, and the overlay. `image` must not be empty.
std::string frame_message(ImageView image, const FrameOverlay& overlay, std::int64_t index,
                          int max_side_px);

}  // namespace dotpose::serve
