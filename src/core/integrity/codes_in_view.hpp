// Codes in view: what all dots in view say of other profiles, rather than those alone that had to
// make the position certain.
#pragma once

#include "core/decode/bit_lines.hpp"
#include "core/integrity/certainty.hpp"

namespace dotpose::core {

/// Weighs the other profiles once more, by a block of bits whose cell (0, 0) stands at `place`,
/// where that may tell more. `has_more_lines`: than had to make the position certain.
void weigh_codes_in_view(const Kernels& kernels, Profile read, const Place& place,
                         const BitBlock& block, const std::array<Confidence, 2>& bits,
                         bool has_more_lines, std::span<ScoredLine> storage, OtherCodes& others);

}  // namespace dotpose::core
