// Expected double alternatives: the odds of all positions that differ from the one found in the
// places of two secondary sequences, by how many lines they share with it, as an expectation over
// the places that they may have. docs/integrity.md.
#pragma once

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Most anchors: lines of the highest ranks.
inline constexpr int kMostAnchors = 12;
/// Alternatives that share so many anchors are always looked at one by one.
inline constexpr int kFewestFound = 7;

/// Returns for each n the expected odds of all that share fewer than n of the first `anchors`
/// ranks.
std::array<float, kFewestFound + 1> expected_double_alternatives(const RankedLines& lines,
                                                                 int anchors);

}  // namespace dotpose::core
