/// Draws the dots and the pose on the luma of a frame.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dotpose/trace.hpp"

namespace dotpose::gstreamer {

/// A luma plane that may be modified.
struct Luma {
    std::uint8_t* pixels = nullptr;
    int width_px = 0;
    int height_px = 0;
    std::ptrdiff_t stride_bytes = 0;
};

/// Draws a ring around each dot and, if there is a fix, an arrow from the reference point along the
/// pattern's x axis. The trace must belong to this frame and contain all stages.
void draw_overlay(const Luma& luma, const Trace& trace);

}  // namespace dotpose::gstreamer
