/// Internal functions of sweeps, declared here for the tests.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/tools/sweep.hpp"

namespace dotpose::evaluate_detail {

std::span<const double> sweep_values(SweepKind kind);

/// Returns frame `index` of the sweep, with the condition set to `value`.
KnownFrame sweep_frame(SweepKind kind, double value, const Setup& setup, std::uint64_t index);

/// Darkens a fraction of the image: all pixels on one side of a straight edge. `direction_rad` is
/// the direction away from the dark side, as an angle from +u towards +v.
void cover(GreyImage& image, double fraction, double direction_rad);

}  // namespace dotpose::evaluate_detail
