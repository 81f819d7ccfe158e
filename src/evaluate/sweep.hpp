/// Parts of a sweep, for the tests.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/tools/evaluate.hpp"

namespace dotpose::evaluate_detail {

std::span<const double> sweep_values(SweepKind kind);

/// Frame `index` with the condition at `value`.
KnownFrame sweep_frame(SweepKind kind, double value, const Setup& setup, std::uint64_t index);

/// Makes this share of the pixels dark: all beyond a straight edge, in the image direction
/// opposite to `direction_rad` (from +u towards +v).
void cover(GreyImage& image, double share, double direction_rad);

}  // namespace dotpose::evaluate_detail
