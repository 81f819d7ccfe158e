/// Interface between main.cpp and a board: three functions that each port in boards/ implements.
/// docs/porting.md describes how to write a port.
#pragma once

#include <cstddef>
#include <cstdint>

// Maximum frame size. Must be one of 36 x 36 (only with known sheets), 160 x 120, 188 x 120 and 320
// x 240 px. The size determines how much memory the program needs. Change the size here, or define
// both macros on the compiler's command line.
#ifndef DOTPOSE_FRAME_WIDTH_PX
#define DOTPOSE_FRAME_WIDTH_PX 188
#define DOTPOSE_FRAME_HEIGHT_PX 120
#endif

namespace board {

inline constexpr int kMaxWidth_px = DOTPOSE_FRAME_WIDTH_PX;
inline constexpr int kMaxHeight_px = DOTPOSE_FRAME_HEIGHT_PX;

/// A frame whose exposure has started.
struct Frame {
    int width_px = 0;          ///< at most kMaxWidth_px
    int height_px = 0;         ///< number of rows that `next_row` returns
    std::int64_t time_us = 0;  ///< middle of the exposure, on a monotonic clock
};

/// Waits until `not_before_us` (on the same clock as Frame::time_us), and then starts a frame. Does
/// not wait if `not_before_us` is 0. During the frame, the camera fills one of two row buffers by
/// DMA while the program reads the other. The first call also initialises the camera and the serial
/// line.
Frame start_frame(std::int64_t not_before_us);

/// Waits for the next row of the frame, from top to bottom, and returns its grey values. The grey
/// values are valid until the next call. The caller must read each row before the camera has
/// delivered the following row.
const std::uint8_t* next_row();

/// Sends bytes over the serial line or radio. The implementation may copy the bytes and return
/// before they are sent.
void send(const std::uint8_t* bytes, std::size_t count);

}  // namespace board
