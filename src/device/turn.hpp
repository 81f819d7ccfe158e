// Turn: rotates and scales the predicted cells to fit the image, after the cells have been shifted.
#pragma once

#include "device/tracking.hpp"

namespace dotpose::core {

/// Measures the dots in the first rows, ring by ring from the middle outwards, and fits the cells
/// to them. Sets the displacement, and the limits on the mass of a dot. If too many dots disagree
/// with the code or too few agree with it, returns false and restores the cells.
bool find_turn(Tracking& tracking);

}  // namespace dotpose::core
