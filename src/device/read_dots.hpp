// Read dots: reads the bits of a tracked frame while its rows arrive.
#pragma once

#include "device/tracking.hpp"

namespace dotpose::core {

/// Starts reading. The cells must already be fitted. Returns false if the dots are displaced too
/// far for the squares around intersections.
bool begin_reading(Tracking& tracking);

/// Reads all dots that are complete in the rows so far. If a dot agrees with the code, adds its
/// offset from the predicted centre to the sums.
void read_ready_dots(Tracking& tracking);

}  // namespace dotpose::core
