// Codes in view: what all dots in view say of other profiles, and not only those that had to make
// the position certain.
#pragma once

#include "core/decode/bit_lines.hpp"
#include "core/integrity/certainty.hpp"

namespace dotpose::core {

/// Weighs the other profiles once more, where that may tell more, by a block of bits whose cell (0,
/// 0) is at `place`. `has_more_lines` says whether the block has more lines than had to make the
/// position certain.
void weigh_codes_in_view(const Kernels& kernels, Profile read, const Place& place,
                         const BitBlock& block, const std::array<Confidence, 2>& bits,
                         bool has_more_lines, std::span<ScoredLine> storage, OtherCodes& others);

}  // namespace dotpose::core
