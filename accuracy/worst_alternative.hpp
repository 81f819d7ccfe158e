/// Finds the wrong position that resembles a true one most.
#pragma once

#include "dotpose/code.hpp"

namespace dotpose {

/// Returns the wrong position that shares the most of the `lines` columns from `place` on with it
/// (or rows, if not `is_along_x`). It differs in the place in one secondary sequence along this
/// axis and in the section. All lines of the other direction are the same.
Place worst_alternative(Profile profile, const Place& place, bool is_along_x, int lines);

}  // namespace dotpose
