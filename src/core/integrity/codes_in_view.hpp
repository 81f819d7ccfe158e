// Codes in view: computes the odds of all codes other than the code that was read. Uses all dots in
// view, whereas the certainty test may use only some of them.
#pragma once

#include "core/decode/bit_lines.hpp"
#include "core/integrity/certainty.hpp"

namespace dotpose::core {

/// Recomputes the odds of the other codes from all bits in the block, if this may change the odds.
/// `read` is the code of the reading. Cell (0, 0) of `block` is at `place`. `bits` contains, for
/// each axis, the agreement of all bits in the block with the code. `has_more_lines` is true if the
/// block has lines that the certainty test did not use. `storage` is working memory for the scores
/// of the lines.
void weigh_codes_in_view(const Kernels& kernels, CodeVariant read, const Place& place,
                         const BitBlock& block, const std::array<Confidence, 2>& bits,
                         bool has_more_lines, std::span<ScoredLine> storage, OtherCodes& others);

}  // namespace dotpose::core
