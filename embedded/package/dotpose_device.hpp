/// Everything that a microcontroller needs from dotpose, in C++20: locating frames row by row,
/// tracking, packets and frame pacing. `dotpose.h` is the equivalent in C.
///
///     static dotpose::DeviceMemory memory;
///     static dotpose::DeviceLocator locator(memory);
///
/// `DeviceMemory` is for frames of 188 x 120 px. For other frame sizes, use
/// `DeviceMemoryFor<160, 120>` or `DeviceMemoryFor<320, 240>`, or `DeviceMemoryFor<36, 36>` with
/// known sheets.
///
/// Include this header before all other dotpose headers, because Arduino finds the library only by
/// the name of this header.
#pragma once

#include "dotpose/frame_pacer.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/pose_packet.hpp"
#include "dotpose/track.hpp"
