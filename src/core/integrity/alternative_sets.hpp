// Alternative sets: the far alternatives, grouped by the sequences in which their places differ
// from the places of the reading. A far alternative differs from the reading in two or more
// sequences. See docs/integrity.md.
#pragma once

#include <array>

namespace dotpose::core {

/// The far alternatives whose places differ from the places of the reading in a given set of
/// sequences. Both members are log2 in units of 2^-8.
struct AlternativeSet {
    int alternatives_q8 = 0;  ///< number of alternatives
    /// Probability that an alternative has the same digits as the reading in a step from one line
    /// to the next.
    int equal_q8 = 0;
};
/// The sets of sequences in which the places differ, in this order:
/// - a3 and one other sequence,
/// - two sequences other than a3,
/// - a3 and two other sequences,
/// - all three sequences other than a3,
/// - all four sequences.
///
/// Each entry combines all choices of sequences other than a3, because a1, a2 and a4 have the same
/// base and therefore the same probability `equal_q8`.
inline constexpr std::array<AlternativeSet, 5> kAlternativeSets{
    {{3694, -661}, {4444, -811}, {5712, -1067}, {6057, -1217}, {7326, -1473}}};
/// log2 of 1.03, the factor `kUnevenness` in expected_alternatives.cpp, in units of 2^-8, rounded
/// up.
inline constexpr int kUnevenness_q8 = 11;

}  // namespace dotpose::core
