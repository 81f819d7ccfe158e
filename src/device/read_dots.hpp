// Read dots: the bits of a tracked frame, as its rows come in.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Begins to read, once the cells are fitted. Returns false if dots are too far from their
/// intersections.
bool begin_reading(Tracking& tracking);

/// Reads all dots that the rows taken so far show. Dots that the code has are measured, and how far
/// they are off the cells is added up.
void read_ready_dots(Tracking& tracking);

}  // namespace dotpose::core
