// Fine grid: fits the predicted plane to the dots of a fine or deformed grid, and reads their bits.
#pragma once

#include "device/tracking.hpp"
#include "dotpose/code.hpp"

namespace dotpose::core {

/// Fits the predicted plane to the dots in `Tracking::found`, independently of the code. Then sets
/// the bits in `Tracking::lines`, and moves `Tracking::corner` by up to one cell along each axis to
/// a place where at least three quarters of the bits agree with the code. Returns the number of
/// dots in the fit. Returns 0 if the dots do not determine a plane, or if there is no such place.
int fit_fine_grid(CodeVariant code, Tracking& tracking, PlaneFromImage& plane,
                  std::int32_t& displacement_q16);

}  // namespace dotpose::core
