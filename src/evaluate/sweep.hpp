/// Internal functions of sweeps, declared here for the tests.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/tools/sweep.hpp"

namespace dotpose::evaluate_detail {

std::span<const double> sweep_values(SweepKind kind);

/// Returns frame `index` of the sweep, with the condition set to `value`.
KnownFrame sweep_frame(SweepKind kind, double value, const Setup& setup, std::uint64_t index);

/// Sets the fraction `share` of the pixels to a dark level. The dark pixels are those on one side
/// of a straight edge, opposite to `direction_rad`, which is an angle in the image from +u towards
/// +v.
void cover(GreyImage& image, double share, double direction_rad);

}  // namespace dotpose::evaluate_detail
