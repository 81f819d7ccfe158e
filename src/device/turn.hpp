// Turn: rotates and scales the shifted cells of a prediction to fit the image.
#pragma once

#include "device/tracking.hpp"

namespace dotpose::core {

/// Measures the dots of the first rows from the middle outwards, ring by ring. After most rings,
/// moves the cells to fit the measured dots. Sets the displacement and the range of masses of dots.
/// Returns false if too many dots contradict the code, or if too few dots agree with the code.
bool find_turn(Tracking& tracking);

}  // namespace dotpose::core
