// Expected double alternatives: the odds of all the positions that differ from the one found in the
// places of two secondary sequences, by how many lines they share with it, as expected over the
// places that they may have. docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Lines of the highest ranks that are told from others.
inline constexpr int kMostAnchors = 12;
/// Sharing so many anchors or more is not expected but found out.
inline constexpr int kFewestFound = 7;

/// By n: the expected odds of all that share fewer than n of the first `anchors` ranks.
std::array<float, kFewestFound + 1> expected_double_alternatives(const RankedLines& lines,
                                                                 int anchors);

}  // namespace dotpose::core
