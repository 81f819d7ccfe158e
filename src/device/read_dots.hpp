// Read dots: reads the bits of a tracked frame while its rows arrive.
#pragma once

#include "device/tracking.hpp"

namespace dotpose::core {

/// Starts reading. The cells must already be fitted. Returns false if the displacement of the dots
/// is too large for the squares around intersections.
bool begin_reading(Tracking& tracking);

/// Reads all dots that are complete in the rows taken so far. Measures the dots that agree with the
/// code, and accumulates their offsets from the predicted centres.
void read_ready_dots(Tracking& tracking);

}  // namespace dotpose::core
