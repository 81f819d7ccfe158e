/// Draws the dots and the pose on the luma of a frame.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dotpose/trace.hpp"

namespace dotpose::gstreamer {

/// The writable luma plane of a frame.
struct Luma {
    std::uint8_t* pixels = nullptr;
    int width_px = 0;
    int height_px = 0;
    std::ptrdiff_t stride_bytes = 0;
};

/// Draws a ring around each dot. If there is a fix, also draws an arrow from the reference point
/// along the x axis of the pattern. The trace must belong to this frame and contain all stages.
void draw_overlay(const Luma& luma, const Trace& trace);

}  // namespace dotpose::gstreamer
