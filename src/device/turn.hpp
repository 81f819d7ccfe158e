// Turn: rotates and scales the shifted cells of a prediction to fit the image.
#pragma once

#include "device/tracking.hpp"

namespace dotpose::core {

/// Measures dots of the first rows from the middle outwards, in rounds, and moves the cells after
/// some of these rounds. Sets the displacement and the mass of dots. Returns false if the dots
/// contradict the code.
bool find_turn(Tracking& tracking);

}  // namespace dotpose::core
