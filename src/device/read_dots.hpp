// Read dots: reads the bits of a tracked frame while its rows arrive.
#pragma once

#include "device/tracking.hpp"

namespace dotpose::core {

/// Prepares the tracked cells for reading. The cells must already be fitted to the image. Returns
/// false if the dots are displaced so far that the pixels read for a dot may be outside the square
/// around its intersection.
bool begin_reading(Tracking& tracking);

/// Reads all dots that have not been read yet and whose pixels have all arrived. If a dot agrees
/// with the code, adds its offset from the predicted centre to the sums for the pose fit.
void read_ready_dots(Tracking& tracking);

}  // namespace dotpose::core
