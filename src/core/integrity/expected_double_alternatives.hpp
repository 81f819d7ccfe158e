// Expected double alternatives: the odds of all positions that differ from the position read in the
// places of two secondary sequences, by the number of lines that they share with it. The odds are
// an expectation over the places. docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Maximum number of anchors. The anchors are the lines with the highest ranks.
inline constexpr int kMaxAnchors = 12;
/// Alternatives that share at least this number of anchors are always counted one by one.
inline constexpr int kMinFound = 7;

/// Returns, for each n, the expected odds of all alternatives that share fewer than n of the
/// `anchors` lines with the highest ranks.
std::array<float, kMinFound + 1> expected_double_alternatives(const RankedLines& lines,
                                                              int anchors);

}  // namespace dotpose::core
