// Expected double alternatives: the expected odds of the positions that differ from the reading in
// the places in two secondary sequences, by the number of shared anchors. The odds are averaged
// over all places. docs/integrity.md derives the expectation.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Maximum number of anchors. The anchors are the lines with the most information, which have the
/// lowest ranks.
inline constexpr int kMaxAnchors = 12;
/// Alternatives that share at least this number of anchors are never part of the expected odds.
inline constexpr int kMinFound = 7;

/// Returns, for each n, the expected sum of the odds of all double alternatives that share fewer
/// than n anchors. The anchors are the lines of ranks 0 to `anchors` - 1.
std::array<float, kMinFound + 1> expected_double_alternatives(const Kernels& kernels,
                                                              const RankedLines& lines,
                                                              int anchors);

}  // namespace dotpose::core
