// Turn: the cells of a prediction, shifted to where they are, are turned and stretched likewise.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Measures dots of the first rows from the middle outwards, and lays the cells anew after each
/// round. Sets how large dots are. False where they are not those that the code has there.
bool find_turn(Tracking& tracking);

}  // namespace dotpose::core
