// Expected double alternatives: the expected odds of positions whose places differ from those of
// the reading in two secondary sequences. The expectation is over all places. See
// docs/integrity.md, "Alternatives: odds".
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Maximum number of anchors. Anchors are the lines with the most information, that is, with the
/// lowest ranks.
inline constexpr int kMaxAnchors = 12;
/// Maximum index n in the result of `expected_double_alternatives`. Element n covers the
/// alternatives that share fewer than n anchors. `Finder` (double_alternatives.cpp) counts all
/// other double alternatives individually.
inline constexpr int kMinFound = 7;

/// Returns, for each n, the expected total odds of all double alternatives that share fewer than n
/// anchors. The anchors are the lines of ranks 0 to `anchors` - 1.
std::array<float, kMinFound + 1> expected_double_alternatives(const Kernels& kernels,
                                                              const RankedLines& lines,
                                                              int anchors);

}  // namespace dotpose::core
