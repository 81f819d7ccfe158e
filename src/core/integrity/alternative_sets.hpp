// Alternative sets: the far alternatives, grouped by the sequences in which their places differ.
// docs/integrity.md.
#pragma once

#include <array>

namespace dotpose::core {

/// Alternatives that differ from the reading in a given set of sequences. Both members are log2 in
/// units of 2^-8.
struct AlternativeSet {
    int alternatives_q8 = 0;  ///< number of alternatives
    /// Probability that all digits of such an alternative in a step equal the digits of the
    /// reading.
    int equal_q8 = 0;
};
/// The sets, in this order: a3 and one other sequence; two sequences other than a3; a3 and two
/// other sequences; all three sequences other than a3; all four sequences. Sequences with the same
/// base are interchangeable.
inline constexpr std::array<AlternativeSet, 5> kAlternativeSets{
    {{3694, -661}, {4444, -811}, {5712, -1067}, {6057, -1217}, {7326, -1473}}};
/// log2(1.03) in units of 2^-8: the logarithm of `kUnevenness` in expected_alternatives.cpp.
inline constexpr int kUnevenness_q8 = 11;

}  // namespace dotpose::core
