// Alternative sets: groups of far alternatives. A far alternative is a position whose places differ
// from those of the reading in two or more secondary sequences. See docs/integrity.md,
// "Alternatives: odds".
#pragma once

#include <array>

namespace dotpose::core {

/// The far alternatives whose places differ from those of the reading in a given set of sequences.
/// Both values are log2 in units of 2^-8.
struct AlternativeSet {
    int alternatives_q8 = 0;  ///< upper bound on the number of combinations of places
    /// Probability that an alternative has the same digit as the reading in every sequence of the
    /// set, for a given step from one line to the next.
    int equal_q8 = 0;
};
/// Sets of sequences in which the place of an alternative differs from the place of the reading:
/// - a3 and one other sequence,
/// - two sequences other than a3,
/// - a3 and two other sequences,
/// - all three sequences other than a3,
/// - all four sequences.
///
/// The digits of a1, a2 and a4 have the same base, so each element combines all sets that differ
/// only in the choice among these three sequences.
inline constexpr std::array<AlternativeSet, 5> kAlternativeSets{
    {{3694, -661}, {4444, -811}, {5712, -1067}, {6057, -1217}, {7326, -1473}}};
/// log2 of the safety factor per step (1.03), in units of 2^-8, rounded up. The factor is necessary
/// because digits are not uniformly distributed. See `kUnevenness` in
/// kernels/loops/alternatives.inc.
inline constexpr int kUnevenness_q8 = 11;

}  // namespace dotpose::core
