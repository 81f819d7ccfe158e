// Read dots: the bits of a tracked frame, as its rows come in.
#pragma once

#include <span>

#include "dotpose/stages.hpp"

namespace dotpose::core {

/// Once the cells lie where they are; false where dots are too far from their intersections.
bool begin_reading(Tracking& tracking);

/// Reads all dots that the rows taken so far show, and adds those that are where and what the code
/// has there to `dots`; their cells stand in `tracking`.
void read_ready_dots(Tracking& tracking, std::span<Dot> dots, int& dot_count);

}  // namespace dotpose::core
