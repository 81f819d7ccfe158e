/// Parts of a sweep that its tests use.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/tools/sweep.hpp"

namespace dotpose::evaluate_detail {

std::span<const double> sweep_values(SweepKind kind);

/// Returns frame `index` with the condition at `value`.
KnownFrame sweep_frame(SweepKind kind, double value, const Setup& setup, std::uint64_t index);

/// Makes a share of the pixels dark: all pixels beyond a straight edge, on the side opposite to the
/// direction `direction_rad`, an angle in the image from +u towards +v.
void cover(GreyImage& image, double share, double direction_rad);

}  // namespace dotpose::evaluate_detail
