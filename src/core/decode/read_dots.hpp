// Read dots: the bits of a tracked frame, as its rows come in.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Once the cells lie where they are; false where dots are too far from their intersections.
bool begin_reading(Tracking& tracking);

/// Reads all dots that the rows taken so far show, and adds up how far those that are what the code
/// has there are off the cells.
void read_ready_dots(Tracking& tracking);

}  // namespace dotpose::core
