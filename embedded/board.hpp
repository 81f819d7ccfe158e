/// What a board must do for main.cpp: three functions, which each port in boards/ fills in.
/// docs/porting.md walks through one.
#pragma once

#include <cstddef>
#include <cstdint>

// The size of frames that there is memory for: 160 x 120, 188 x 120 or 320 x 240. Change it here,
// or by options of the compiler.
#ifndef DOTPOSE_FRAME_WIDTH_PX
#define DOTPOSE_FRAME_WIDTH_PX 188
#define DOTPOSE_FRAME_HEIGHT_PX 120
#endif

namespace board {

inline constexpr int kMostWidth_px = DOTPOSE_FRAME_WIDTH_PX;
inline constexpr int kMostHeight_px = DOTPOSE_FRAME_HEIGHT_PX;

/// A frame whose exposure has been started.
struct Frame {
    int width_px = 0;          ///< at most kMostWidth_px
    int height_px = 0;         ///< rows that `next_row` will give
    std::int64_t time_us = 0;  ///< middle of the exposure, on a clock that never runs backwards
};

/// Waits until `not_before_us` on that clock (0: at once), and starts a frame: from now on the
/// camera fills one of two row buffers by DMA while the other one is read. The first call also sets
/// up camera and serial line.
Frame start_frame(std::int64_t not_before_us);

/// Waits for the next row of the frame, from the top, and returns its grey values. They stay valid
/// until the next call, so a row takes at least as long to come in as the one before to be read.
const std::uint8_t* next_row();

/// Sends bytes over the serial line or radio. It may return before they are out, with a copy.
void send(const std::uint8_t* bytes, std::size_t count);

}  // namespace board
