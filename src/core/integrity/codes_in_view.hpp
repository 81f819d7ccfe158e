// Codes in view: the odds of the other codes, computed from all dots in view instead of only the
// dots that made the position certain.
#pragma once

#include "core/decode/bit_lines.hpp"
#include "core/integrity/certainty.hpp"

namespace dotpose::core {

/// Recomputes the odds of the other codes if further bits may change these odds. `place` is the
/// place of cell (0, 0) of `block`. `has_more_lines` is true if the block has more lines than were
/// used to make the position certain.
void weigh_codes_in_view(const Kernels& kernels, CodeVariant read, const Place& place,
                         const BitBlock& block, const std::array<Confidence, 2>& bits,
                         bool has_more_lines, std::span<ScoredLine> storage, OtherCodes& others);

}  // namespace dotpose::core
