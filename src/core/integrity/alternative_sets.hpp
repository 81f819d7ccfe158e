// Alternative sets: groups of far alternatives. A far alternative differs from the reading in the
// places in two or more secondary sequences. See docs/integrity.md, "Alternatives: odds".
#pragma once

#include <array>

namespace dotpose::core {

/// The far alternatives that differ from the reading in the same set of sequences. Both values are
/// log2 in units of 2^-8.
struct AlternativeSet {
    int alternatives_q8 = 0;  ///< number of alternatives
    /// Probability that, in one step from a line to the next, an alternative has the same digits as
    /// the reading in all sequences of the set.
    int equal_q8 = 0;
};
/// Sets of sequences in which the place of an alternative differs from the place of the reading:
/// - a3 and one other sequence,
/// - two sequences other than a3,
/// - a3 and two other sequences,
/// - all three sequences other than a3,
/// - all four sequences.
///
/// a1, a2 and a4 have the same base. Each element therefore covers all choices among these three
/// sequences.
inline constexpr std::array<AlternativeSet, 5> kAlternativeSets{
    {{3694, -661}, {4444, -811}, {5712, -1067}, {6057, -1217}, {7326, -1473}}};
/// log2 of the safety factor 1.03 for digits that are not uniformly distributed, in units of 2^-8,
/// rounded up. See `kUnevenness` in kernels/loops/alternatives.inc.
inline constexpr int kUnevenness_q8 = 11;

}  // namespace dotpose::core
