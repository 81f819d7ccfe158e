/// All of dotpose that a microcontroller needs, for C++20: locating rows of a frame, following the
/// movement, packets, pacing. `dotpose.h` is the same for C.
///
///     static dotpose::DeviceMemory memory;
///     static dotpose::DeviceLocator locator(memory);
///
/// `DeviceMemory` is for frames of 188 x 120 px; there are also DeviceMemoryFor<160, 120> and
/// DeviceMemoryFor<320, 240>.
///
/// Arduino finds this library by this header: include it before any other of dotpose.
#pragma once

#include "dotpose/frame_pacer.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/pose_packet.hpp"
#include "dotpose/track.hpp"
