// Turn: turns and stretches the cells of a prediction, after they were shifted, to fit the image.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Measures dots of the first rows from the middle outwards, and moves the cells after rounds. Sets
/// the displacement and mass of dots. Returns false if the dots are not those of the code.
bool find_turn(Tracking& tracking);

}  // namespace dotpose::core
